#include "study/sampling_balance.h"

#include "base/number_text.h"

#include <cmath>

namespace plumbline::study
{
  namespace
  {
    bool is_as_good(const SetStatistics &set, const SetStatistics &largest)
    {
      constexpr double part = .1,
                       rounding = 1e-10; // of the mean's size, as trend.cc judges errors
      return std::abs(*set.mean_error - *largest.mean_error) <=
             part * *largest.mean_error + rounding * largest.mean_size;
    }

    /// @param sets  with errors, few samples to many
    SamplingBalance balance_of(const Key &of, const std::vector<const SetStatistics *> &sets)
    {
      const SetStatistics &largest = *sets.back();
      SamplingBalance balance{of.method,       of.problem,    of.series,           of.h,
                              largest.n_modes, largest.count, *largest.mean_error, {},
                              largest.rule};
      // from the largest down: what is as good by chance does not count
      for (std::size_t s = sets.size() - 1; s-- > 0 && is_as_good(*sets[s], largest);)
        balance.enough = sets[s]->count;
      return balance;
    }
  } // namespace

  std::vector<SamplingBalance> find_balance(const std::vector<CaseStatistics> &cases)
  {
    std::vector<SamplingBalance> result;
    for (const CaseStatistics &one : cases)
    {
      if (one.is_target_level)
        continue;
      std::map<std::pair<uq::SampleRule, unsigned int>, std::vector<const SetStatistics *>> sets;
      for (const SetStatistics &set : one.sets)
        if (set.mean_error)
          sets[{set.rule, set.n_modes}].push_back(&set);
      for (const auto &[rule_and_modes, known] : sets)
        if (known.size() > 1)
          result.push_back(balance_of(one.of, known));
    }
    return result;
  }

  std::string words_of(const SamplingBalance &balance, bool has_modes, bool has_rules)
  {
    std::string text = balance.method;
    for (const std::string &name : {balance.problem, balance.series})
      if (!name.empty())
        text += ", " + name;
    text += ", h = " + base::to_text(balance.h, 4);
    if (has_rules)
      text += ", " + base::word(balance.rule);
    if (has_modes)
      text += ", modes " + std::to_string(balance.n_modes);
    const std::string error = base::to_text(balance.error, 3),
                      largest = "count " + std::to_string(balance.largest);
    if (!balance.enough)
      return text + ": samples still limit the error of the mean, " + error + " at " + largest +
             "; it differs by more than a tenth from that of the count before. Take more samples";
    return text + ": beyond count " + std::to_string(*balance.enough) +
           " more samples do not reduce the error of the mean, " + error + " at " + largest +
           "; the rest is due to h" + (has_modes ? " or to omitted modes" : "");
  }
} // namespace plumbline::study
