#include "study/cheapest.h"

#include "study/solution_record.h"
#include "study/trend.h"

#include <algorithm>
#include <set>
#include <sstream>
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

  double relative_error(const Record &run, const std::string &error)
  {
    return run[error] / size_of(run, error);
  }

  std::string relative_to(const std::string &error)
  {
    if (is_energy(error))
      return "the energy norm of the solution";
    const bool is_l2 = norm_of_one(error, 4) != 1;
    if (is_truncation(error))
      return std::string("the largest load") + (is_l2 ? " times the root of the area" : "");
    return std::string("the variation of the solution (maximum minus minimum") +
           (is_l2 ? ", times the root of the area)" : ")");
  }

  std::string words_of(const StudyResults &results, const Advice &advice, const Choice &choice)
  {
    std::ostringstream text;
    text << "cheapest to a relative error of " << choice.target << ": " << choice.method
         << " at h = " << choice.h;
    for (const Record &run : results.records)
      if (run.key.method == choice.method && run.key.problem == advice.problem &&
          run.key.series == advice.series && run.key.h == choice.h)
      {
        text << ", relative error " << relative_error(run, results.decisive_error);
        break;
      }
    text << ", " << choice.seconds << " CPU s";
    for (std::size_t i = 0; i < choice.tied.size(); ++i)
      text << (i == 0 ? "; a tie with " : ", ") << choice.tied[i];
    return text.str();
  }
} // namespace plumbline::study
