#include "scene/crack_section.h"

#include "base/error.h"
#include "scene/keys.h"
#include "scene/values.h"

#include <cmath>

namespace plumbline::scene
{
  void CrackSection::declare(Keys &keys)
  {
    keys.add("notch", notch, any_number(),
             "Length of a notch from the left edge of a strip (Domain/boxes) along its midline, a "
             "multiple of h; bonds across it carry no force. Nodes within one horizon beyond the "
             "upper and lower edges are constrained (grips); the left and right ends are free. "
             "'plumbline crack' runs the scene. 0: no notch. [length]");
    keys.add("load", load, any_number(),
             "Strain energy stored in the strip relative to the threshold W H of crack growth; at "
             "1 a long crack neither grows nor closes.");
    keys.add("start", start,
             "Initial state of the strip, at rest. opened: linear elastic equilibrium with the "
             "notch. sudden: uniform strain as without a notch, so that the notch opens at t = 0 "
             "and emits waves.");
    keys.add("samples", n_samples, count(6, 100000),
             "Number of equidistant times at which the crack tip and the energies are recorded.");
    keys.add(
        "checkpoint interval", interval, count(1, 100000),
        "Number of samples between checkpoints; an interrupted run resumes from the last one.");
  }

  void CrackSection::complete() const
  {
    const auto require =
        [](bool is_good, const std::string &key, double value, const std::string &otherwise)
    {
      if (!is_good)
        throw InputError("Crack/" + key + " = " + short_number(value) + " " + otherwise);
    };
    require(notch >= 0 && std::isfinite(notch), "notch", notch,
            "must be a length > 0, or 0 for no crack");
    require(load > 0 && std::isfinite(load), "load", load,
            "must be positive and finite; 1 is the threshold");
  }
} // namespace plumbline::scene
