#include "scene/strip_section.h"

#include "base/error.h"
#include "scene/keys.h"
#include "scene/values.h"

#include <cmath>

namespace plumbline::scene
{
  void StripSection::declare(Keys &keys)
  {
    keys.add(
        "height", height, any_number(),
        "Of a strip between rigid grips that move apart by 2, an even multiple of h. [length]");
    keys.add(
        "length", length, any_number(),
        "Of the strip, a multiple of h; three heights leave 1e-4 of a tip's energy to what its "
        "ends do, four 1e-5. 'plumbline strip' runs the scene. 0: there is none. [length]");
    keys.add("crack", crack, any_number(),
             "Of the strip along its middle from its left end, behind which it goes on without "
             "end; a multiple of h. [length]");
    keys.add(
        "edges", edges,
        "grips: rigid ones above and below move apart by 2, and a crack gets W1 for its "
        "advance (Rice 1968). K field: all around the strip is held at the field of a crack at "
        "K = 1 whose tip is half a column ahead, and a crack that goes on by a column gets "
        "K^2/E' as h and the horizon vanish (Irwin 1957).");
    keys.add("growth", n_growth, count(0, 1000),
             "Columns of nodes that a second crack grows through, bond by bond, by meshfree rules, "
             "after its first two: what it needs and what it sets free is told over G, the "
             "toughness of the law. 0: it stands alone.");
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
            "must be a length > 0, or 0 where there is no strip");
    if (!is_there())
      return;
    require(height > 0 && std::isfinite(height), "height", height, "must be a length > 0");
    if (n_growth > 0 && edges != StripEdges::grips)
      throw InputError("Strip/growth = " + std::to_string(n_growth) +
                       " needs Strip/edges = grips, between which a crack gets W1 all the way");
    require(crack > 0 && crack < length, "crack", crack,
            "must end in the strip, between 0 and Strip/length = " + short_number(length));
  }
} // namespace plumbline::scene
