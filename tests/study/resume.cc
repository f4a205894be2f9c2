// A sweep takes over what an earlier one has finished, and nothing of what it has not.
#include "study/statics.h"

#include "meshfree/method.h"
#include "reference/method.h"
#include "study/comparison.h"
#include "study/preflight.h"
#include "study/statement_lists.h"

#include "tests/study/given_solutions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace plumbline;
using namespace plumbline::study;

namespace
{
  Methods all_methods()
  {
    Methods available = meshfree::methods();
    for (const auto &method : reference::methods())
      available.push_back(method);
    return available;
  }

  StudyResults sweep(const scene::Scene &scene, const StudyResults &earlier = {})
  {
    const Methods available = all_methods();
    return run_sweep(scene, choose_methods(scene, available), available, {}, earlier);
  }

  /// Two levels of two methods, with a reference.
  scene::Scene two_levels()
  {
    return scene::parse_scene("test.prm", "",
                              {{"Problem/solution", "x^3"},
                               {"Methods/names", "FA, Q1"},
                               {"Reference/method", "Q2"},
                               {"Study/norms", "averages L2"},
                               {"Study/decisive error", "averages L2 | reference"},
                               {"Study/m", "2"},
                               {"Study/h", "0.25, 0.125"},
                               {"Geometry/checks", "0"}});
  }
} // namespace

TEST(SweepResume, runs_the_whole_of_a_level_that_is_not_finished)
{
  const StudyResults whole = sweep(two_levels());
  ASSERT_EQ(whole.records.size(), 4u);
  for (std::size_t n_done = 0; n_done <= 4; ++n_done)
  {
    StudyResults earlier = whole;
    earlier.is_complete = false;
    earlier.records.resize(n_done);
    earlier.references.resize((n_done + 1) / 2);
    const StudyResults resumed = sweep(two_levels(), earlier);
    EXPECT_TRUE(resumed.is_complete);
    ASSERT_EQ(resumed.records.size(), 4u) << n_done;
    for (std::size_t i = 0; i < 4; ++i)
    {
      EXPECT_EQ(resumed.records[i].key.method, whole.records[i].key.method) << n_done;
      EXPECT_EQ(resumed.records[i].key.level, whole.records[i].key.level) << n_done;
      const double error = whole.records[i][whole.decisive_error];
      EXPECT_NEAR(resumed.records[i][whole.decisive_error], error, 1e-9 * error) << n_done;
    }
    ASSERT_EQ(resumed.references.size(), 2u) << n_done;
    EXPECT_EQ(resumed.references[1].level, 1u);
  }
}

TEST(SweepResume, keeps_the_estimates_of_finished_levels)
{
  StudyResults earlier = sweep(two_levels());
  earlier.is_complete = false;
  earlier.records.resize(2);
  earlier.references.resize(1);
  earlier.references[0].estimate = 77; // so that it is known again
  const StudyResults resumed = sweep(two_levels(), earlier);
  ASSERT_EQ(resumed.references.size(), 2u);
  EXPECT_EQ(resumed.references[0].estimate, 77);
  EXPECT_NE(resumed.references[1].estimate, 77);
  EXPECT_TRUE(resumed.estimates.empty());
}

TEST(SweepResume, tells_each_statement_once_however_often_it_is_interrupted)
{
  const scene::Scene scene = two_levels();
  const StudyResults whole = sweep(scene);
  StudyResults told;
  const auto add = [&](const StudyResults &made)
  {
    const auto append = [&](auto list)
    { (told.*list).insert((told.*list).end(), (made.*list).begin(), (made.*list).end()); };
    append(&StudyResults::records);
    for_each_statement_list(append);
  };
  for (std::size_t n = 1; n <= 4; ++n) // the second method of a level makes its reference again
  {
    SweepControl control;
    control.on_made = add;
    control.should_stop = [&] { return told.records.size() == n; };
    run_sweep(scene, choose_methods(scene, all_methods()), all_methods(), control, told);
    ASSERT_EQ(told.records.size(), n);
    ASSERT_EQ(told.references.size(), (n + 1) / 2);
  }
  EXPECT_EQ(told.references[1].level, 1u);
  EXPECT_EQ(told.maps.size(), whole.maps.size());
  EXPECT_EQ(told.savings.size(), whole.savings.size());
  EXPECT_EQ(told.warnings, whole.warnings);
}

namespace
{
  /// Its averages are no numbers.
  class BrokenMethod : public GivenSolutions
  {
  public:
    BrokenMethod() : GivenSolutions("broken") {}

  private:
    method::Field field(const problem::Problem<2> &problem) const override
    {
      method::Field solution;
      solution.averages.assign(comparison_points(problem).size(),
                               std::numeric_limits<double>::quiet_NaN());
      return solution;
    }
  };
} // namespace

TEST(SweepErrors, that_are_no_numbers_are_a_failure_and_are_not_stored)
{
  const Methods methods = {std::make_shared<BrokenMethod>()};
  const scene::Scene scene = scene::parse_scene("test.prm", "",
                                                {{"Problem/solution", "x"},
                                                 {"Methods/names", "broken"},
                                                 {"Study/norms", "averages L2"},
                                                 {"Study/decisive error", "averages L2 | exact"},
                                                 {"Solver/operator", "sparse"},
                                                 {"Study/m", "2"},
                                                 {"Study/h", "0.25"}});
  const StudyResults results = run_sweep(scene, methods, methods, at_cost());
  ASSERT_EQ(results.records.size(), 1u);
  EXPECT_NE(results.records[0].failure.find("not a finite number"), std::string::npos)
      << results.records[0].failure;
}
