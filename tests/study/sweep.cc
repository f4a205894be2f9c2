// What a sweep adds to its solves: estimates, what the smallest model saved, what a budget leaves
// out.
#include "study/statics.h"

#include "meshfree/method.h"
#include "reference/method.h"
#include "scene/problem.h"
#include "study/comparison.h"
#include "study/preflight.h"
#include "study/saving.h"
#include "study/solution_record.h"

#include "tests/study/given_solutions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

using namespace plumbline;
using namespace plumbline::study;

namespace
{
  StudyResults sweep(const std::vector<scene::Override> &settings)
  {
    const scene::Scene scene = scene::parse_scene("test.prm", "", settings);
    Methods available = meshfree::methods();
    for (const auto &method : reference::methods())
      available.push_back(method);
    return run_sweep(scene, choose_methods(scene, available), available, {});
  }

  /// A cubic, which the nonlocal operator maps as the local one does, but the scene does not know
  /// that it solves the problem.
  const std::vector<scene::Override> unknown = {{"Problem/load", "-(3*x + 2)"},
                                                {"Problem/constraint", "x^3 + 2*y^2"},
                                                {"Problem/local solution", "x^3 + 2*y^2"},
                                                {"Study/regime", "delta"},
                                                {"Study/m", "3"},
                                                {"Study/h", "0.1, 0.05, 0.025"},
                                                {"Study/decisive error", "averages L2 | local"},
                                                {"Study/norms", "averages L2"},
                                                {"Geometry/checks", "0"}};

  std::vector<scene::Override> with(std::vector<scene::Override> settings,
                                    const std::vector<scene::Override> &more)
  {
    settings.insert(settings.end(), more.begin(), more.end());
    return settings;
  }
} // namespace

TEST(SweepEstimates, bound_the_error_of_galerkin_solutions_that_nothing_stands_beside)
{
  constexpr double generous = 10; // an estimate this far above the error would be of no use
  const StudyResults results = sweep(with(unknown, {{"Methods/names", "IPA-AC, Q1, DGQ1"}}));
  ASSERT_EQ(results.estimates.size(), 2 * 3u); // of Q1 and DGQ1 at three levels
  for (const ErrorEstimate &one : results.estimates)
    for (const study::Record &run : results.records)
      if (run.key.method == one.method && run.key.level == one.level)
      {
        const double error = run["averages L2 | local"];
        EXPECT_LE(error, one.estimate) << run.key.method << ' ' << run.key.h;
        EXPECT_LE(one.estimate, generous * error) << run.key.method << ' ' << run.key.h;
      }
}

TEST(SweepEstimates, are_made_where_the_scene_asks_for_them)
{
  const std::vector<scene::Override> small = {
      {"Study/h", "0.125"}, {"Methods/names", "FA, Q1"}, {"Geometry/checks", "0"}};
  const auto known = with(small, {{"Problem/solution", "x^3"}});
  EXPECT_EQ(sweep(known).estimates.size(), 0u);
  EXPECT_EQ(sweep(with(known, {{"Reference/estimate", "every"}})).estimates.size(), 1u);
  const auto open = with(with(unknown, small), {{"Study/h", "0.1"}});
  EXPECT_EQ(sweep(open).estimates.size(), 1u);
  EXPECT_EQ(sweep(with(open, {{"Reference/estimate", "none"}})).estimates.size(), 0u);
  const auto referred = with(open, {{"Reference/method", "Q2"}});
  EXPECT_EQ(sweep(referred).estimates.size(), 0u);
  EXPECT_EQ(sweep(referred).references.size(), 1u);
  // the reference has its own, though it is a method of the scene too
  const auto both =
      sweep(with(referred, {{"Reference/method", "Q1"}, {"Reference/estimate", "every"}}));
  EXPECT_EQ(both.estimates.size(), 0u);
  EXPECT_EQ(both.references.size(), 1u);
}

TEST(SweepSavings, are_measured_at_the_first_level_of_the_first_method_of_each_side)
{
  constexpr double rounding = 1e-11;
  const std::vector<scene::Override> small = {{"Study/h", "0.125, 0.0625"},
                                              {"Methods/names", "FA, IPA-AC, Q1, DGQ0"},
                                              {"Problem/solution", "x^3"},
                                              {"Solver/tolerance", "1e-13"},
                                              {"Geometry/checks", "0"}};
  const StudyResults results = sweep(small);
  ASSERT_EQ(results.savings.size(), 2u);
  EXPECT_EQ(results.savings[0].method, "FA");
  EXPECT_EQ(results.savings[1].method, "Q1");
  for (const Saving &saving : results.savings)
  {
    EXPECT_EQ(saving.h, .125);
    EXPECT_GT(saving.smallest.seconds(), 0);
    EXPECT_GT(saving.full.seconds(), 0);
    EXPECT_EQ(saving.full.n_unknowns, saving.smallest.n_unknowns);
    EXPECT_LT(saving.difference, rounding) << saving.method;
  }
  for (const Saving &saving : sweep(with(small, {{"Problem/solution", "1e6*x^3"}})).savings)
    EXPECT_LT(saving.difference, rounding) << saving.method; // it is relative
  for (const scene::Override &same : {scene::Override{"Solver/model", "full"},
                                      {"Solver/operator", "sparse"},
                                      {"Domain/mesh", "squares"}})
    EXPECT_TRUE(sweep(with(small, {same})).savings.empty()) << same.key;
}

namespace
{
  /// Nodes with the values 1, 2, ..., from the last one to the first in the full model, where the
  /// value 2 is off by a given defect.
  class BackwardMethod : public GivenSolutions
  {
  public:
    explicit BackwardMethod(double defect) : GivenSolutions("backward"), defect_(defect) {}

  private:
    method::Field field(const problem::Problem<2> &problem) const override
    {
      method::Field solution;
      solution.nodes = {{.25, .25}, {.75, .25}, {.25, .75}, {.75, .75}};
      solution.nodal = {1, 2, 3, 4};
      if (problem.settings.solver.is_full_model)
      {
        solution.nodal[1] += defect_;
        std::reverse(solution.nodes.begin(), solution.nodes.end());
        std::reverse(solution.nodal.begin(), solution.nodal.end());
      }
      return solution;
    }

    double defect_;
  };
} // namespace

TEST(SweepSavings, compare_values_at_the_same_place_in_whatever_order_nodes_come)
{
  const problem::Level level{.5, 1};
  const scene::Scene scene = scene::parse_scene(
      "test.prm", "", {{"Methods/names", "FA"}, {"Problem/solution", "x"}, {"Study/h", "0.5"}});
  for (const double defect : {0., .5})
  {
    const BackwardMethod method(defect);
    const scene::Case one = scene::make_case(scene, 0, level);
    const Solution solution = analysis::solve(method, one.problem);
    const auto saving = measure_saving(one, method, solution);
    ASSERT_TRUE(saving);
    EXPECT_EQ(saving->difference, defect / 4);
  }
  // lattices number the unknowns of Q2 by families, meshes by cells
  const StudyResults results = sweep({{"Study/h", "0.125"},
                                      {"Methods/names", "Q2"},
                                      {"Problem/solution", "x^3"},
                                      {"Solver/tolerance", "1e-13"},
                                      {"Geometry/checks", "0"}});
  ASSERT_EQ(results.savings.size(), 1u);
  EXPECT_LT(results.savings[0].difference, 1e-11);
}

namespace
{
  /// Zero everywhere.
  class DearMethod : public GivenSolutions
  {
  public:
    DearMethod() : GivenSolutions("dear") {}

  private:
    method::Field field(const problem::Problem<2> &problem) const override
    {
      method::Field solution;
      solution.averages.assign(comparison_points(problem).size(), 0.);
      return solution;
    }
  };
} // namespace

TEST(SweepBudget, leaves_out_what_the_levels_before_say_is_too_dear)
{
  const auto dear = std::make_shared<DearMethod>();
  const Methods methods = {dear};
  const scene::Scene scene = scene::parse_scene("test.prm", "",
                                                {{"Problem/solution", "x"},
                                                 {"Methods/names", "dear"},
                                                 {"Solver/operator", "sparse"},
                                                 {"Study/norms", "averages L2"},
                                                 {"Study/decisive error", "averages L2 | exact"},
                                                 {"Study/h", "0.1, 0.05, 0.025, 0.0125"}});
  // each level costs four times the one before
  SweepControl control =
      at_cost([](const problem::Problem<2> &problem) { return std::pow(.1 / problem.h, 2); });
  control.budget = 5; // levels of 1 and 4 seconds; the next ones would take 16 and 64
  const StudyResults results = run_sweep(scene, methods, methods, control);
  EXPECT_EQ(results.records.size(), 2u);
  ASSERT_EQ(results.left_out.size(), 2u);
  EXPECT_NE(results.left_out[0].find("h = 0.025: some 16 CPU s"), std::string::npos)
      << results.left_out[0];
  EXPECT_EQ(dear->n_solves, 2u);
  // after one level the next is expected to take four times as long
  control.budget = 2;
  const auto again = std::make_shared<DearMethod>();
  EXPECT_EQ(run_sweep(scene, {again}, {again}, control).records.size(), 1u);
  control.budget = 5;
  // what is finished is not run again, and a larger budget goes on from there
  control.budget = 20;
  const StudyResults more = run_sweep(scene, methods, methods, control, results);
  EXPECT_EQ(more.records.size(), 3u);
  EXPECT_EQ(more.left_out.size(), 1u);
  EXPECT_EQ(dear->n_solves, 3u);
}

namespace
{
  /// A solid and its field at a Poisson's ratio.
  const std::vector<scene::Override> of_nu = {{"Random/variables", "nu: uniform 0.25 0.45"},
                                              {"Kernel/type", "1/r"},
                                              {"Kernel/limit", "Navier"},
                                              {"Material/model", "LPS"},
                                              {"Material/E", "1"},
                                              {"Material/nu", "nu"},
                                              {"Problem/solution", "x^3 - y^2*x, nu*sin(x + 2*y)"},
                                              {"Methods/names", "IPA-AC, Q1"},
                                              {"Study/m", "3"},
                                              {"Study/h", "0.1"},
                                              {"Study/norms", "nodal Linf"}};
} // namespace

TEST(SweepOverAVariable, is_that_of_scenes_at_its_values)
{
  const StudyResults results = sweep(with(of_nu, {{"Study/regime", "variable"},
                                                  {"Study/variable", "nu"},
                                                  {"Study/values", "0.25, 0.3, 0.45"}}));
  ASSERT_EQ(results.records.size(), 2 * 3u);
  EXPECT_EQ(results.variable, "nu");
  for (const study::Record &run : results.records)
  {
    std::ostringstream value;
    value << run.key.value;
    for (const study::Record &other : sweep(with(of_nu, {{"Random/values", value.str()}})).records)
      if (other.key.method == run.key.method)
      {
        EXPECT_EQ(errors_of(run), errors_of(other)) << run.key.method << ", nu = " << run.key.value;
      }
  }
  for (const Trend &trend : results.trends)
  {
    EXPECT_EQ(trend.axis, Axis::variable);
    EXPECT_EQ(trend.x, (std::vector<double>{.25, .3, .45}));
    EXPECT_TRUE(trend.rates.empty()); // errors over nu have no order
    EXPECT_EQ(trend.verdict.rfind("at most ", 0), 0u) << trend.verdict;
    EXPECT_NE(trend.reason.find(" at nu = 0.25 to "), std::string::npos) << trend.reason;
  }
  EXPECT_TRUE(results.advice[0].choices.empty()); // nothing converges here
}
