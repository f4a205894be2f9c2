#include "base/error.h"
#include "scene/checks.h"
#include "scene/models/model.h"
#include "scene/values.h"

#include <cmath>

namespace plumbline::scene
{
  void check_strip(const Scene &scene)
  {
    const StripSection &strip = scene.strip;
    if (!strip.is_there())
      return;
    const auto needs = [&](bool is_good, const std::string &what)
    {
      if (!is_good)
        throw InputError("Strip/length = " + short_number(strip.length) + " needs " + what);
    };
    needs(!scene.crack.is_there() && !scene.fracture.is_there() && !scene.time.is_dynamic(),
          "Crack/notch = 0, Fracture/toughness empty and Time/final time = 0: its crack is "
          "stationary");
    needs(scene.material.model == &lps() && !scene.has_dilatation() && scene.is_homogeneous(),
          "Material/model = LPS of constants with lambda = mu (nu = 1/4 in plane strain), which "
          "has bond forces only");
    needs(is_inverse_distance(scene.kernel),
          "Kernel/type = 1/r: other influence functions are not tested with cracks");
    needs(scene.domain.mesh.is_lattice() && scene.domain.cracks.empty() &&
              scene.domain.outside.empty() && !scene.domain.is_free_body,
          "the default values of Domain: the strip defines its own edges and crack");
    needs(scene.domain.boxes.exclude.empty() && !scene.domain.collar,
          "Domain/holes empty and Domain/interaction domain = auto");
    needs(
        scene.problem.solutions.empty() && scene.problem.loads.empty() && !scene.problem.constraint,
        "Problem/solution, load and constraint empty: the relative displacement of the grips is 2");
    needs(scene.methods.nodes.kind() == NodeKind::centres && scene.methods.nodes.perturbation == 0,
          "nodes at centres that are not moved (Methods/nodes)");
    for (const Series &series : scene.study.series)
      for (const Level &level : series.levels)
      {
        const std::string at = " (Study/h = " + short_number(level.h) + ")";
        const auto check =
            [&](const std::string &key, double value, double unit, const std::string &of)
        {
          constexpr double tolerance = 1e-9; // lengths are written in decimals
          if (std::abs(value / unit - std::round(value / unit)) > tolerance)
            throw InputError("Strip/" + key + " = " + short_number(value) + " is " +
                             short_number(value / level.h) + " mesh sizes" + at + "; give " + of +
                             " of h");
        };
        check("height", strip.height, 2 * level.h, "an even multiple");
        check("length", strip.length, level.h, "a multiple");
        check("crack", strip.crack, level.h, "a multiple");
        if (strip.height < 4 * level.horizon)
          throw InputError("Strip/height = " + short_number(strip.height) +
                           " is less than four horizons, " + short_number(4 * level.horizon) + at +
                           "; increase it, or decrease Study/h or Study/m");
        const double grown = strip.n_growth > 0 ? (strip.n_growth + 2) * level.h : 0;
        if (std::min(strip.crack, strip.length - strip.crack - grown) < 2 * level.horizon)
          throw InputError("Strip/crack = " + short_number(strip.crack) + " ends " +
                           (grown > 0 ? "after its growth " : "") +
                           "within two horizons of an end of the strip" + at +
                           "; give a longer strip (Strip/length), or a shorter horizon");
      }
  }
} // namespace plumbline::scene
