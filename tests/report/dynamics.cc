// What a page of motions advises.
#include "report/dynamics_tables.h"

#include <gtest/gtest.h>

using namespace plumbline;

namespace
{
  study::MotionRun motion(unsigned int level, double step, double error, double seconds)
  {
    study::MotionRun run;
    run.method = "FA";
    run.scheme = "velocity Verlet";
    run.level = level;
    run.step = step;
    run.errors["nodal L2 | exact"] = error;
    run.cost.solve_seconds = seconds;
    return run;
  }
} // namespace

TEST(DynamicsReport, best_runs_are_those_that_no_other_beats_in_error_and_time)
{
  study::DynamicResults results;
  results.decisive_error = "nodal L2 | exact";
  results.runs = {motion(0, .1, 1e-2, 1), motion(0, .05, 5e-3, 2), motion(1, .1, 6e-3, 3),
                  motion(1, .05, 1e-3, 4)};
  const auto best = report::best_runs(results);
  ASSERT_EQ(best.size(), 3u); // the third is dearer and worse than the second
  EXPECT_EQ(best[0], &results.runs[0]);
  EXPECT_EQ(best[1], &results.runs[1]);
  EXPECT_EQ(best[2], &results.runs[3]);
}

TEST(DynamicsReport, best_runs_are_none_whose_errors_cancel)
{
  study::DynamicResults results;
  results.decisive_error = "nodal L2 | exact";
  results.runs = {motion(0, .1, 1e-5, 1), motion(0, .05, 5e-3, 2), motion(0, .025, 5.01e-3, 4)};
  const auto best = report::best_runs(results);
  ASSERT_EQ(best.size(), 1u);
  EXPECT_EQ(best[0], &results.runs[1]); // that the shortest step is a little worse is no luck
}
