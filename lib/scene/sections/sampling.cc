#include "base/error.h"
#include "physics/expression.h"
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
          throw InputError("'" + name + "' is not a count; write whole numbers separated by ','");
        counts.push_back(static_cast<unsigned int>(number));
      }
      return counts;
    }

    /// Of each rule, separated by ';'.
    std::vector<std::vector<unsigned int>> to_lists(const std::string &text)
    {
      std::vector<std::vector<unsigned int>> lists;
      for (const std::string &part : physics::split_outside_brackets(text, ';'))
        lists.push_back(to_counts(part));
      return text.empty() ? std::vector<std::vector<unsigned int>>() : lists;
    }

    std::vector<uq::SampleRule> to_rules(const std::string &text)
    {
      if (text == none)
        return {};
      std::vector<uq::SampleRule> rules;
      for (const std::string &name : to_names(text))
        rules.push_back(*base::from_word<uq::SampleRule>(name));
      return rules;
    }
  } // namespace

  std::string SamplingSection::rule_words() const
  {
    std::vector<std::string> words;
    for (const uq::SampleRule rule : rules)
      words.push_back(base::word(rule));
    return rules.empty() ? none : join(words, ", ");
  }

  void SamplingSection::declare(Keys &keys)
  {
    const auto &words = base::words<uq::SampleRule>;
    keys.add(
        "rule", none, some_of({words.begin(), words.end()}),
        [this](const std::string &text) { rules = to_rules(text); },
        "Sampling rule of 'plumbline sample', or several separated by ',', which are compared on "
        "one page. tensor: tensor products of Gauss rules (Hermite, "
        "Legendre). Smolyak: sparse grids, with some negative weights. Monte Carlo: independent "
        "samples. quasi-Monte Carlo: Sobol points. equidistant: equidistant points over the range "
        "of uniform variables; with one variable, charts show the results as functions of it. "
        "Chebyshev: tensor products of Chebyshev points (roots of T_n) of uniform variables, for "
        "interpolation. With several rules the first one leads: pictures and tables of samples "
        "show its last set, which is also the target 'own finest level'.");
    keys.add("analysis", analysis,
             "Analysis of each sample. scene: the analysis that the scene defines: statics, "
             "transient (Time), dynamic fracture (Crack), quasi-static fracture (Fracture) or "
             "stationary crack (Strip). stability, dispersion: the analyses of these commands.");
    keys.add(
        "counts", "", any_text(), [this](const std::string &text) { counts = to_lists(text); },
        "Size of each set of samples, increasing: points per variable (tensor, Chebyshev, "
        "equidistant), "
        "levels 0, 1, ... (Smolyak), or number of samples. For several rules give one list for "
        "each, in their order, separated by ';', or one list for all.");
    keys.add(
        "modes", "", any_text(), [this](const std::string &text) { modes = to_counts(text); },
        "Numbers of modes (Random/modes) that vary, increasing, each combined with every count; "
        "the other modes are 0. Empty: all vary.");
    keys.add("growth", growth,
             "Points per variable at level l of the Smolyak rule: linear, l Gauss points (l = 1 at "
             "level 0); odd, 2l - 1; doubling, 2^l - 1; nested, 1, 3, 5, 9, ... Clenshaw-Curtis "
             "points for uniform variables, 1, 3, 9, 19, 35 Genz-Keister points for normal ones.");
    keys.add("seed", seed, count(0),
             "Monte Carlo: seed of the random numbers; the same seed gives the same samples.");
  }
} // namespace plumbline::scene
