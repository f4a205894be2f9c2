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
             "Length of a notch in the left edge of a strip (Domain/boxes) along its middle, a "
             "multiple of h; its bonds carry no force. Grips hold all nodes within a horizon "
             "beyond the upper and lower edge; both ends are free. 'plumbline crack' runs the "
             "scene. 0: none. [length]");
    keys.add("load", load, any_number(),
             "What the grips' strain puts into the strip, over the threshold: 1 is the energy W H "
             "at which a long crack neither grows nor closes.");
    keys.add("start", start,
             "The strip when its motion begins, at rest: opened, in equilibrium with the notch "
             "open as small strains have it; or sudden, as if there were no notch, which opens at "
             "once and sends waves.");
    keys.add("samples", n_samples, count(6, 100000),
             "Times at equal distances at which tip and energies are noted.");
    keys.add("checkpoint interval", interval, count(1, 100000),
             "Samples between checkpoints; a run that was killed goes on from the last one.");
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
            "must be a length > 0, or 0 where there is no crack");
    require(load > 0 && std::isfinite(load), "load", load,
            "must be positive and finite; 1 is the threshold");
  }
} // namespace plumbline::scene
