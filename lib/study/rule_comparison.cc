#include "study/rule_comparison.h"

#include "base/number_text.h"

#include <algorithm>

namespace plumbline::study
{
  namespace
  {
    using ErrorOf = std::optional<double> SetStatistics::*;

    /// Sets of one rule and all modes that have an error, few samples to many.
    using Sets = std::vector<const SetStatistics *>;

    std::vector<Sets> sets_by_rule(const CaseStatistics &one, ErrorOf error)
    {
      std::vector<Sets> rules;
      uq::SampleRule last = uq::SampleRule::none;
      for (const SetStatistics &set : one.sets)
        if (set.*error && set.n_modes == one.sets.back().n_modes)
        {
          if (rules.empty() || set.rule != last)
            rules.emplace_back();
          rules.back().push_back(&set);
          last = set.rule;
        }
      return rules;
    }

    RuleComparison compare(const CaseStatistics &one, const std::string &quantity, ErrorOf error,
                           const std::vector<Sets> &rules)
    {
      constexpr double part = .1,
                       rounding = 1e-10; // of the mean's size, as in sampling_balance.cc
      RuleComparison result{
          one.of.method, one.of.problem, one.of.series, one.of.h, quantity, 0, {}};
      double size = 0;
      for (const Sets &sets : rules)
      {
        result.error = std::max(result.error, *(sets.back()->*error));
        size = std::max(size, sets.back()->mean_size);
      }
      const double most = (1 + part) * result.error + rounding * size;
      for (const Sets &sets : rules)
      {
        // from the largest down: what is as good by chance does not count
        std::size_t s = sets.size() - 1;
        while (s > 0 && *(sets[s - 1]->*error) <= most)
          --s;
        result.needs.push_back({sets[s]->rule, sets[s]->n_samples});
      }
      std::stable_sort(result.needs.begin(), result.needs.end(),
                       [](const auto &a, const auto &b) { return a.n_samples < b.n_samples; });
      return result;
    }
  } // namespace

  std::vector<RuleComparison> compare_rules(const std::vector<CaseStatistics> &cases)
  {
    const std::vector<std::pair<std::string, ErrorOf>> quantities = {
        {"mean", &SetStatistics::mean_error}, {"deviation", &SetStatistics::deviation_error}};
    std::vector<RuleComparison> result;
    for (const CaseStatistics &one : cases)
      for (const auto &[quantity, error] : quantities)
        if (const std::vector<Sets> rules = sets_by_rule(one, error);
            one.is_finest && rules.size() > 1)
          result.push_back(compare(one, quantity, error, rules));
    return result;
  }

  std::string words_of(const RuleComparison &comparison)
  {
    std::string place = comparison.method, needs, best;
    for (const std::string &name : {comparison.problem, comparison.series})
      if (!name.empty())
        place += ", " + name;
    for (const RuleComparison::Need &need : comparison.needs)
    {
      const std::string rule = base::word(need.rule);
      needs += (needs.empty() ? "" : ", ") + rule + " " + std::to_string(need.n_samples);
      if (need.n_samples == comparison.needs.front().n_samples)
        best += (best.empty() ? "" : " and ") + rule;
    }
    return place + ", h = " + base::to_text(comparison.h, 4) + ": " + best + " " +
           (best.find(" and ") == std::string::npos ? "needs" : "need") +
           " the fewest samples for an error of the " + comparison.quantity +
           " that all rules reach, " + base::to_text(comparison.error, 3) + " (" + needs +
           " samples)";
  }
} // namespace plumbline::study
