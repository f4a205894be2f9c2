#include "base/error.h"
#include "base/number_text.h"
#include "scene/checks.h"
#include "scene/values.h"

#include <algorithm>

namespace plumbline::scene
{
  using uq::SampleRule;

  namespace
  {
    constexpr double most_samples = 1e6;

    /// Points in each variable, in all combinations.
    bool is_tensor(SampleRule rule)
    {
      return rule == SampleRule::tensor || rule == SampleRule::equidistant ||
             rule == SampleRule::chebyshev;
    }

    double n_samples(SampleRule rule, const SamplingSection &sampling,
                     const std::vector<uq::Law> &laws, unsigned int count)
    {
      if (is_tensor(rule))
        return uq::n_tensor_points(laws.size(), count);
      if (rule == SampleRule::smolyak)
        return uq::n_smolyak_points(laws, count, sampling.growth);
      return count;
    }

    /// Of the largest rule of one variable; 0 where there are none.
    double n_line_points(SampleRule rule, const SamplingSection &sampling,
                         const std::vector<uq::Law> &laws, unsigned int count)
    {
      double most = is_tensor(rule) ? count : 0.;
      if (rule == SampleRule::smolyak)
        for (const uq::Law law : laws)
          most = std::max(most, uq::n_line_points(law, sampling.growth, count + 1));
      return most;
    }

    /// @param count  of the largest set
    void check_size(SampleRule rule, const SamplingSection &sampling,
                    const std::vector<uq::Law> &laws, unsigned int count)
    {
      const double n = n_samples(rule, sampling, laws, count) *
                       static_cast<double>(std::max<std::size_t>(1, sampling.modes.size())),
                   n_line = n_line_points(rule, sampling, laws, count);
      const bool is_smolyak = rule == SampleRule::smolyak,
                 is_line_too_large = n_line > uq::most_line_points;
      const std::string key = "Sampling/counts = " + std::to_string(count) +
                              " with Sampling/rule = " + base::word(rule),
                        fewer = is_smolyak ? "take a lower level" : "take fewer";
      require(n <= most_samples,
              key + " and " + std::to_string(laws.size()) +
                  (laws.size() == 1 ? " variable " : " variables ") +
                  (sampling.modes.empty() ? "" : "for each of Sampling/modes ") + "takes " +
                  (is_smolyak && is_line_too_large ? "at least " : "") + base::to_text(n, 4) +
                  " samples, more than " + base::to_text(most_samples, 4) + "; " + fewer +
                  (is_tensor(rule) ? ", or Sampling/rule = Smolyak" : "") +
                  (is_smolyak ? ", or Sampling/rule = quasi-Monte Carlo" : ""));
      require(!is_line_too_large, key + " takes " + base::to_text(n_line, 4) +
                                      " points of a variable, more than " +
                                      base::to_text(uq::most_line_points, 4) +
                                      ", the limit of a one-dimensional rule; " + fewer +
                                      ", or Sampling/rule = quasi-Monte Carlo");
    }

    /// One of the rules with its counts.
    void check_rule(SampleRule one, const Scene &scene, const std::vector<unsigned int> &counts)
    {
      const SamplingSection &sampling = scene.sampling;
      const std::string rule = "Sampling/rule = " + base::word(one);
      const std::vector<uq::Law> laws = scene.random.laws();
      const bool is_drawn = one == SampleRule::monte_carlo, is_smolyak = one == SampleRule::smolyak,
                 is_bounded = one == SampleRule::equidistant || one == SampleRule::chebyshev,
                 are_uniform = std::all_of(laws.begin(), laws.end(),
                                           [](uq::Law law) { return law == uq::Law::uniform; });
      require(!laws.empty() || (is_drawn && scene.random.is_there()),
              rule + " needs random variables; give Random/variables, or Random/"
                     "modes of a field");
      require(
          is_drawn || !scene.random.is_drawn_whole(),
          rule + " samples random variables, but Random/field = " + base::word(scene.random.field) +
              " has complete realisations without variables; give Random/modes, or "
              "Sampling/rule = Monte Carlo");
      require(!counts.empty(), rule + " needs Sampling/counts, which is empty");
      require(std::is_sorted(counts.begin(), counts.end()) &&
                  std::adjacent_find(counts.begin(), counts.end()) == counts.end(),
              "Sampling/counts must be strictly increasing: the last set is the most accurate");
      require(!is_bounded || are_uniform,
              rule + " covers a bounded range, and normal variables are unbounded; make them "
                     "uniform in Random/variables (and give no Random/modes), or write tensor");
      require(is_smolyak || counts.front() > 0,
              "Sampling/counts = 0 with " + rule + " gives no sample; write 1 or more");
      require(!is_smolyak || sampling.growth != uq::Growth::nested ||
                  counts.back() < uq::n_genz_keister_rules || are_uniform,
              "Sampling/counts = " + std::to_string(counts.back()) +
                  " with Sampling/growth = nested: of normal variables there are levels 0 to " +
                  std::to_string(uq::n_genz_keister_rules - 1) + " (35 points); write odd");
      check_size(one, sampling, laws, counts.back());
    }

    /// Rules that may stand together, and counts for them.
    void check_list(const SamplingSection &sampling)
    {
      const auto &rules = sampling.rules;
      const std::string key = "Sampling/rule = " + sampling.rule_words();
      for (const SampleRule one : rules)
      {
        require(std::count(rules.begin(), rules.end(), one) == 1,
                key + ": '" + base::word(one) +
                    "' occurs twice; give each rule once, with all its sizes in Sampling/counts");
        require(!sampling.has_several_rules() ||
                    (one != SampleRule::none && one != SampleRule::equidistant),
                key + ": '" + base::word(one) + "' " +
                    (one == SampleRule::none
                         ? "stands for no samples"
                         : "spans ranges of variables that are then not random") +
                    ", and cannot be compared with other rules; write it alone, or remove it");
      }
      require(sampling.counts.size() <= 1 || sampling.counts.size() == rules.size(),
              "Sampling/counts has " + std::to_string(sampling.counts.size()) +
                  " lists separated by ';' for " + key +
                  "; give one list for each rule, in their order, or one for all");
    }
  } // namespace

  void check_sampling(const Scene &scene)
  {
    const SamplingSection &sampling = scene.sampling;
    if (!sampling.is_there())
      return;
    check_list(sampling);
    const std::vector<unsigned int> &modes = sampling.modes;
    require(modes.empty() || (modes.front() > 0 && modes.back() <= scene.random.n_modes &&
                              std::is_sorted(modes.begin(), modes.end()) &&
                              std::adjacent_find(modes.begin(), modes.end()) == modes.end()),
            "Sampling/modes must be strictly increasing, from 1 or more to Random/modes = " +
                std::to_string(scene.random.n_modes) +
                " at most; give Random/modes the largest of them, or clear it");
    for (std::size_t i = 0; i < sampling.rules.size(); ++i)
      check_rule(sampling.rules[i], scene,
                 sampling.counts.empty() ? std::vector<unsigned int>() : sampling.counts_of(i));
  }
} // namespace plumbline::scene
