#include "study/cheapest.h"

#include <algorithm>
#include <set>
#include <string>
#include <tuple>

namespace plumbline::study
{
  std::vector<const Record *> cheapest(std::vector<const Record *> runs)
  {
    if (runs.empty())
      return {};
    const auto least = std::min_element(runs.begin(), runs.end(),
                                        [](const Record *a, const Record *b)
                                        { return a->cost.seconds() < b->cost.seconds(); });
    const double most = tie_ratio * (*least)->cost.seconds() + tie_seconds;
    runs.erase(std::remove_if(runs.begin(), runs.end(),
                              [most](const Record *run) { return run->cost.seconds() > most; }),
               runs.end());
    const auto rank = [](const Record *run)
    { return std::tuple(run->cost.n_unknowns, run->key.method, run->cost.seconds()); };
    std::stable_sort(runs.begin(), runs.end(),
                     [&](const Record *a, const Record *b) { return rank(a) < rank(b); });
    std::set<std::string> seen; // one run a method
    runs.erase(std::remove_if(runs.begin(), runs.end(),
                              [&](const Record *run)
                              { return !seen.insert(run->key.method).second; }),
               runs.end());
    return runs;
  }
} // namespace plumbline::study
