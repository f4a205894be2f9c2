#include "study/cheapest_pair.h"

#include "study/cheapest.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace plumbline::study
{
  namespace
  {
    /// Whether errors are below a target in a set and stay there, in larger ones and at finer
    /// levels: what falls below by chance, where errors of h and of samples cancel, does not count.
    bool stays_below(double target, const std::vector<CaseStatistics> &cases,
                     const CaseStatistics &one, const SetStatistics &set)
    {
      const auto is_below = [&](const SetStatistics &other)
      {
        return other.rule != set.rule || other.count < set.count || other.n_modes < set.n_modes ||
               other.is_target ||
               (other.mean_error && *other.mean_error <= target * other.mean_size);
      };
      return std::all_of(cases.begin(), cases.end(),
                         [&](const CaseStatistics &other)
                         {
                           return !other.of.is_same_series(one.of) ||
                                  other.of.level < one.of.level ||
                                  std::all_of(other.sets.begin(), other.sets.end(), is_below);
                         });
    }

    /// The largest error of a set and larger ones at its level: errors of h and of samples may
    /// cancel in one of them.
    double error_from(const CaseStatistics &one, const SetStatistics &set)
    {
      double largest = 0;
      for (const SetStatistics &other : one.sets)
        if (other.rule == set.rule && other.count >= set.count && other.n_modes >= set.n_modes &&
            !other.is_target && other.mean_error)
          largest = std::max(largest, *other.mean_error);
      return largest;
    }

    /// Of pairs of one problem, series and rule that are as cheap as the cheapest, the simplest.
    CheapestPair simplest(const std::vector<CheapestPair> &pairs)
    {
      const auto least = std::min_element(pairs.begin(), pairs.end(),
                                          [](const CheapestPair &a, const CheapestPair &b)
                                          { return a.seconds < b.seconds; });
      const double most = tie_ratio * least->seconds + tie_seconds;
      CheapestPair best = *least;
      for (const CheapestPair &pair : pairs)
        if (pair.seconds <= most &&
            std::make_tuple(pair.count, pair.n_modes, -pair.h, pair.method) <
                std::make_tuple(best.count, best.n_modes, -best.h, best.method))
          best = pair;
      return best;
    }
  } // namespace

  std::vector<CheapestPair> find_cheapest(const std::vector<CaseStatistics> &cases)
  {
    constexpr unsigned int n_targets = 8;
    std::vector<CheapestPair> result;
    for (unsigned int k = 1; k <= n_targets; ++k)
    {
      const double target = std::pow(10., -static_cast<double>(k));
      std::map<std::string, std::vector<CheapestPair>> pairs; // by problem, series and rule
      for (const CaseStatistics &one : cases)
        for (const SetStatistics &set : one.sets)
          if (set.mean_error && !one.is_target_level && stays_below(target, cases, one, set))
            pairs[one.of.problem + "\n" + one.of.series + "\n" + base::word(set.rule)].push_back(
                {one.of.method, one.of.problem, one.of.series, target, error_from(one, set),
                 one.of.h, set.seconds, set.count, set.n_modes, set.rule});
      for (const auto &[key, known] : pairs)
        result.push_back(simplest(known));
    }
    return result;
  }
} // namespace plumbline::study
