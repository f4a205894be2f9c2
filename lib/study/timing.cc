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

  std::optional<double> expected_seconds(const std::vector<Record> &runs, const std::string &method,
                                         const std::string &problem, const std::string &series,
                                         unsigned int level)
  {
    constexpr double usual_growth = 4; // unknowns, as h halves
    if (level == 0)
      return 0;
    const auto find = [&](unsigned int wanted) -> const Record *
    {
      for (const Record &run : runs)
        if (is_same_run(run, method, problem, series, wanted))
          return &run;
      return nullptr;
    };
    const Record *last = find(level - 1);
    if (last == nullptr)
      return {};
    const Record *before = level < 2 ? nullptr : find(level - 2);
    const double growth = before == nullptr || before->cost.seconds() == 0
                              ? usual_growth
                              : last->cost.seconds() / before->cost.seconds();
    return growth * last->cost.seconds();
  }
} // namespace plumbline::study
