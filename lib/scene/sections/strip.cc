#include "scene/strip_section.h"

#include "base/error.h"
#include "scene/keys.h"
#include "scene/values.h"

#include <cmath>

namespace plumbline::scene
{
  void StripSection::declare(Keys &keys)
  {
    keys.add("height", height, any_number(),
             "Height of the strip between rigid grips with a relative displacement of 2, an even "
             "multiple of h. [length]");
    keys.add("length", length, any_number(),
             "Length of the strip, a multiple of h; the ends change the crack-tip energy by 1e-4 "
             "at three heights, and by 1e-5 at four. 'plumbline strip' runs the scene. 0: no "
             "strip. [length]");
    keys.add("crack", crack, any_number(),
             "Length of the crack in the strip, along its midline from the left end, beyond which "
             "crack and strip continue to infinity; a multiple of h. [length]");
    keys.add("edges", edges,
             "grips: rigid grips above and below with a relative displacement of 2; the energy "
             "release rate of the crack is W1 (Rice 1968). K field: the displacement around the "
             "strip is that of a crack at K = 1 whose tip is half a column ahead; the energy "
             "release rate tends to K^2/E' as h and the horizon tend to 0 (Irwin 1957).");
    keys.add("growth", n_growth, count(0, 1000),
             "Number of node columns through which a second crack grows bond by bond, with "
             "meshfree methods, after its first two; the energies required and released are "
             "reported relative to G, the toughness of the bond law. 0: no growth.");
  }

  void StripSection::complete() const
  {
    const auto require =
        [](bool is_good, const std::string &key, double value, const std::string &otherwise)
    {
      if (!is_good)
        throw InputError("Strip/" + key + " = " + short_number(value) + " " + otherwise);
    };
    require(length >= 0 && std::isfinite(length), "length", length,
            "must be a length > 0, or 0 for no strip");
    if (!is_there())
      return;
    require(height > 0 && std::isfinite(height), "height", height, "must be a length > 0");
    if (n_growth > 0 && edges != StripEdges::grips)
      throw InputError("Strip/growth = " + std::to_string(n_growth) +
                       " needs Strip/edges = grips, where the energy release rate is constant, W1");
    require(crack > 0 && crack < length, "crack", crack,
            "must end in the strip, between 0 and Strip/length = " + short_number(length));
  }
} // namespace plumbline::scene
