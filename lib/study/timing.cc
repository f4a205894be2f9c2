#include "study/timing.h"

#include "base/communicator.h"

#include <algorithm>

namespace plumbline::study
{
  namespace
  {
    bool is_short(const analysis::Outcome &outcome)
    {
      constexpr double short_seconds = .02;
      return outcome.solution && outcome.solution->cost.seconds() < short_seconds;
    }
  } // namespace

  std::vector<analysis::Outcome>
  solve_and_time(const std::function<std::vector<analysis::Outcome>()> &solve)
  {
    auto outcomes = solve();
    const int n_repeats = base::Communicator::all().n_ranks() == 1 ? 2 : 0;
    for (int repeat = 0;
         repeat < n_repeats && std::any_of(outcomes.begin(), outcomes.end(), is_short); ++repeat)
    {
      const auto again = solve();
      for (std::size_t i = 0; i < outcomes.size(); ++i)
        if (is_short(outcomes[i]) && again[i].solution &&
            again[i].solution->cost.seconds() < outcomes[i].solution->cost.seconds())
        {
          base::Cost &cost = outcomes[i].solution->cost;
          cost.setup_seconds = again[i].solution->cost.setup_seconds;
          cost.solve_seconds = again[i].solution->cost.solve_seconds;
        }
    }
    return outcomes;
  }

  bool is_same_run(const Record &run, const std::string &method, const std::string &problem,
                   const std::string &series, unsigned int level)
  {
    return run.key.method == method && run.key.problem == problem && run.key.series == series &&
           run.key.level == level;
  }
} // namespace plumbline::study
