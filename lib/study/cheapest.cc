#include "study/cheapest.h"

#include <algorithm>
#include <set>
#include <string>
#include <tuple>

namespace plumbline::study
{
  std::vector<const Run *> cheapest(std::vector<const Run *> runs)
  {
    if (runs.empty())
      return {};
    const auto least = std::min_element(runs.begin(), runs.end(),
                                        [](const Run *a, const Run *b)
                                        { return a->cost.seconds() < b->cost.seconds(); });
    const double most = tie_ratio * (*least)->cost.seconds() + tie_seconds;
    runs.erase(std::remove_if(runs.begin(), runs.end(),
                              [most](const Run *run) { return run->cost.seconds() > most; }),
               runs.end());
    const auto rank = [](const Run *run)
    { return std::tuple(run->cost.n_unknowns, run->method, run->cost.seconds()); };
    std::stable_sort(runs.begin(), runs.end(),
                     [&](const Run *a, const Run *b) { return rank(a) < rank(b); });
    std::set<std::string> seen; // one run a method
    runs.erase(std::remove_if(runs.begin(), runs.end(),
                              [&](const Run *run) { return !seen.insert(run->method).second; }),
               runs.end());
    return runs;
  }
} // namespace plumbline::study
