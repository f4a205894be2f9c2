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
                     const CaseStatistics &one, std::size_t set)
    {
      return std::all_of(cases.begin(), cases.end(),
                         [&](const CaseStatistics &other)
                         {
                           return !other.of.is_same_method(one.of) ||
                                  other.of.level < one.of.level ||
                                  std::all_of(other.sets.begin() + static_cast<std::ptrdiff_t>(set),
                                              other.sets.end(),
                                              [&](const SetStatistics &s)
                                              { return s.mean_error && *s.mean_error <= target; });
                         });
    }

    /// Of pairs of one problem and series that are as cheap as the cheapest, the simplest.
    CheapestPair simplest(const std::vector<CheapestPair> &pairs)
    {
      const auto least = std::min_element(pairs.begin(), pairs.end(),
                                          [](const CheapestPair &a, const CheapestPair &b)
                                          { return a.seconds < b.seconds; });
      const double most = tie_ratio * least->seconds + tie_seconds;
      CheapestPair best = *least;
      for (const CheapestPair &pair : pairs)
        if (pair.seconds <= most && std::make_tuple(pair.count, -pair.h, pair.method) <
                                        std::make_tuple(best.count, -best.h, best.method))
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
      std::map<std::string, std::vector<CheapestPair>> pairs; // by problem and series
      for (const CaseStatistics &one : cases)
        for (std::size_t s = 0; s < one.sets.size(); ++s)
          if (const SetStatistics &set = one.sets[s]; stays_below(target, cases, one, s))
            pairs[one.of.problem + "\n" + one.of.series].push_back(
                {one.of.method, one.of.problem, one.of.series, target, *set.mean_error, one.of.h,
                 set.seconds, set.count});
      for (const auto &[key, known] : pairs)
        result.push_back(simplest(known));
    }
    return result;
  }
} // namespace plumbline::study
