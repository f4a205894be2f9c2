#include "study/sampling_findings.h"

#include "base/number_text.h"

namespace plumbline::study
{
  std::vector<std::string> find_findings(const SamplingResults &results)
  {
    constexpr double rounding = 1e-12; // of the sum of weights
    std::vector<std::string> findings;
    const auto say = [&](const std::string &text) { findings.push_back(text); };
    if (results.spectrum && results.spectrum->is_grey())
      say(words_of(*results.spectrum) + ", so that all samples are near the mean field");
    if (const std::size_t n = results.random.files.size();
        results.random.is_drawn_whole() && n > 0 && results.n_samples > n)
      say(std::to_string(results.n_samples) + " samples take " + std::to_string(n) +
          " of Random/files in turn, some more than once: standard errors count all as "
          "independent, which samples of one file are not; take no more samples than files, or "
          "Random/modes");
    for (const CaseStatistics &one : results.cases)
      for (const SetStatistics &set : one.sets)
      {
        const std::string where =
            one.of.method + ", h = " + base::to_text(one.of.h, 4) +
            (results.sampling.has_several_rules() ? ", " + base::word(set.rule) : "") +
            (results.sampling.modes.empty() ? "" : ", modes " + std::to_string(set.n_modes)) +
            ", count " + std::to_string(set.count) + ": ";
        for (const auto &[name, statistics] : set.quantities)
          if (statistics.variance < 0)
            say(where + "the variance of " + name + " is " + base::to_text(statistics.variance, 4) +
                ", which no quantity has: weights are negative (sum of sizes " +
                base::to_text(set.sum_of_sizes, 4) + "), and its deviation is not known");
        for (const auto &[name, statistics] : set.quantities)
          if (set.sum_of_sizes > 1 + rounding &&
              (statistics.mean < statistics.least || statistics.mean > statistics.largest))
            say(where + "the mean of " + name + " is " + base::to_text(statistics.mean, 4) +
                ", and samples are between " + base::to_text(statistics.least, 4) + " and " +
                base::to_text(statistics.largest, 4) +
                ": negative weights extrapolate, which is right where variables act one by one, "
                "and else is noise");
        if (set.negative_part > 0)
          say(where + "the variance of the field is negative in " +
              base::to_text(100 * set.negative_part, 3) +
              " % of the domain: weights are negative (sum of sizes " +
              base::to_text(set.sum_of_sizes, 4) + "), and its deviation is not known" +
              (set.is_target ? ", so that those of other sets are held against nothing" : ""));
        if (set.mean_error && set.mean_uncertainty > .1 * *set.mean_error)
          say(where + "the exact mean is known to " + base::to_text(set.mean_uncertainty, 3) +
              " only, no tenth of its error");
      }
    return findings;
  }
} // namespace plumbline::study
