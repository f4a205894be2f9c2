#include "base/error.h"
#include "scene/keys.h"
#include "scene/random_section.h"
#include "scene/values.h"

#include <cmath>

namespace plumbline::scene
{
  namespace
  {
    std::vector<unsigned int> to_counts(const std::string &text)
    {
      std::vector<unsigned int> counts;
      for (const std::string &name : to_names(text))
      {
        const double number = name.empty() ? -1 : to_number(name);
        if (!(number >= 0 && number <= 1e9) || number != std::floor(number))
          throw InputError("'" + name + "' is no count; write whole numbers separated by ','");
        counts.push_back(static_cast<unsigned int>(number));
      }
      return counts;
    }
  } // namespace

  void SamplingSection::declare(Keys &keys)
  {
    keys.add(
        "rule", rule,
        "Where 'plumbline sample' takes the scene. tensor: Gauss points (Hermite, Legendre) in "
        "each variable. Smolyak: sparse combinations of them, some weights negative. Monte "
        "Carlo: independent samples. quasi-Monte Carlo: Sobol's points. equidistant: from end to "
        "end of uniform variables; of one variable, charts of what depends on it.");
    keys.add("analysis", analysis,
             "What is done with a sample. of the scene: statics, a motion (Time), a moving crack "
             "(Crack), growth (Fracture) or a standing crack (Strip), as the scene has it; "
             "stability, dispersion: what these commands measure.");
    keys.add(
        "counts", "", any_text(), [this](const std::string &text) { counts = to_counts(text); },
        "Of each set of samples, few to many: points a variable (tensor, equidistant), levels 0, "
        "1, ... "
        "(Smolyak), or samples.");
    keys.add(
        "modes", "", any_text(), [this](const std::string &text) { modes = to_counts(text); },
        "How many of Random/modes vary, few to many, the others 0: each with every count. Empty: "
        "all.");
    keys.add("growth", growth,
             "Points of a variable at level l of Smolyak's rule: linear, l Gauss points (l = 1 at "
             "level 0); odd, 2l - 1; doubling, 2^l - 1; nested, 1, 3, 5, 9, ... points of Clenshaw "
             "and Curtis for uniform variables, 1, 3, 9, 19, 35 of Genz and Keister for normal "
             "ones.");
    keys.add("seed", seed, count(0), "Of random numbers; the same seed gives the same samples.");
  }
} // namespace plumbline::scene
