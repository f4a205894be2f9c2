#include "study/comparison.h"
#include "base/error.h"
#include "scene/problem.h"
#include "study/preflight.h"
#include "study/statics.h"

#include "method/lattice_discretisation.h"
#include "tests/study/given_solutions.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::study;

namespace
{
  scene::Scene make_scene(const std::string &more = "",
                          const std::string &solution = "x^3*y^2 + y^4")
  {
    return scene::parse_scene("test.prm",
                              "subsection Problem\n set solution = " + solution +
                                  "\nend\nsubsection Methods\n set names = fake\nend\n" + more);
  }

  /// The exact solution plus a known error, as if a method had found it.
  class FakeMethod : public GivenSolutions
  {
  public:
    explicit FakeMethod(double rate, double plateau = 0)
        : GivenSolutions("fake"), rate_(rate), plateau_(plateau)
    {
    }
    std::string why_not(const problem::Problem<2> &problem) const override
    {
      return problem.lattice() ? "" : "it is for lattices";
    }

  private:
    method::Field field(const problem::Problem<2> &problem) const override
    {
      const double error = plateau_ + std::pow(problem.lattice()->h(), rate_);
      const auto cells = method::comparison_nodes(problem, problem.n_components);
      method::Field solution;
      solution.nodes = method::free_points(*problem.lattice(), cells);
      for (const auto &node : solution.nodes)
        solution.nodal.push_back(problem.solution->value(node, 0) + error);
      solution.averages = cell_averages(*problem.solution, *problem.lattice(), cells);
      for (double &average : solution.averages)
        average -= error;
      const auto exact = problem.solution->value;
      solution.value = [exact, error](const dealii::Point<2> &x, unsigned int c)
      { return exact(x, c) + error; };
      return solution;
    }

    double rate_, plateau_;
  };
} // namespace

TEST(CellAverages, are_exact_for_polynomials_at_centres_and_vertices)
{
  for (const std::string nodes : {"centres", "vertices"})
  {
    const auto scene = make_scene("subsection Methods\n set nodes = " + nodes + "\nend\n");
    const auto problem = make_problem(scene, 0, {.125, .25});
    const auto cells = method::comparison_nodes(problem, 1);
    const auto averages = cell_averages(*problem.solution, *problem.lattice(), cells);
    std::size_t index = 0;
    const auto mean = [](int power, double a, double b)
    { return (std::pow(b, power + 1) - std::pow(a, power + 1)) / (power + 1) / (b - a); };
    for (int j = 0; j < cells.n[1]; ++j)
      for (int i = 0; i < cells.n[0]; ++i)
        if (cells.free(0, i, j))
        {
          const double x = .125 * (i + cells.axis[0].offset), y = .125 * (j + cells.axis[0].offset);
          const double x0 = x - .0625, x1 = x + .0625, y0 = y - .0625, y1 = y + .0625;
          EXPECT_NEAR(averages[index++], mean(3, x0, x1) * mean(2, y0, y1) + mean(4, y0, y1),
                      1e-14);
        }
    EXPECT_EQ(index, averages.size());
  }
}

TEST(CellAverages, without_a_series_agree_with_those_with_one)
{
  const auto scene = make_scene();
  const auto problem = make_problem(scene, 0, {.25, .25});
  const auto cells = method::comparison_nodes(problem, 1);
  problem::Field<2> pointwise = *problem.solution;
  pointwise.series.reset();
  const auto a = cell_averages(*problem.solution, *problem.lattice(), cells);
  const auto b = cell_averages(pointwise, *problem.lattice(), cells);
  EXPECT_LT(averages_l2(problem, a, b), 1e-13);
}

TEST(CoarsenAverages, of_exact_fine_averages_are_exact_coarse_averages)
{
  for (const std::string nodes : {"centres", "vertices"})
  {
    const std::string holes = "subsection Domain\n set holes = 0.5, 0.5 : 1, 1\nend\n";
    const auto scene = make_scene(holes + "subsection Methods\n set nodes = " + nodes + "\nend\n");
    const auto fine_scene = make_scene(holes);
    const auto coarse = make_problem(scene, 0, {.125, .25}),
               fine = make_problem(fine_scene, 0, {.0625, .25});
    const auto cells = method::comparison_nodes(coarse, 1);
    const auto fine_cells = method::comparison_nodes(fine, 1);
    const auto coarsened = coarsen_averages(
        cell_averages(*fine.solution, *fine.lattice(), fine_cells), fine_cells, cells);
    EXPECT_LT(
        averages_l2(coarse, coarsened, cell_averages(*coarse.solution, *coarse.lattice(), cells)),
        1e-14);
  }
}

TEST(Errors, are_those_put_in)
{
  const auto scene =
      make_scene("subsection Study\n set norms = nodal Linf, nodal L2, averages Linf, averages "
                 "L2, field Linf, field L2\nend\n");
  const auto problem = make_problem(scene, 0, {.1, .3});
  const auto solution = analysis::solve(FakeMethod(2), problem);
  const auto reference = std::vector<double>(solution.averages.size(), 0.);
  const auto found = errors(scene.study.norms, problem, solution, {reference, {}});
  for (const std::string norm :
       {"nodal Linf", "nodal L2", "averages Linf", "averages L2", "field Linf", "field L2"})
    EXPECT_NEAR(found.at(norm + " | exact"), .01, 1e-13) << norm;
  EXPECT_NEAR(found.at("averages L2 | reference"),
              averages_l2(problem, solution.averages, reference), 1e-15);
  EXPECT_EQ(found.count("nodal Linf | reference"), 0u);
}

TEST(Errors, of_vectors_are_of_each_component)
{
  const auto scene = scene::parse_scene("test.prm", "",
                                        {{"Kernel/type", "bond-tensor"},
                                         {"Kernel/limit", "Navier"},
                                         {"Problem/solution", "1 + x, y^2"},
                                         {"Methods/names", "fake"},
                                         {"Study/norms", "nodal Linf, nodal L2"}});
  const auto problem = make_problem(scene, 0, {.1, .3});
  Solution solution;
  solution.nodes = {{.25, .5}, {.75, .5}};
  solution.nodal = {1.25, .25 + .3, 1.75 - .4, .25};
  const auto found = errors(scene.study.norms, problem, solution, {});
  EXPECT_NEAR(found.at("nodal Linf | exact"), .4, 1e-14);
  EXPECT_NEAR(found.at("nodal L2 | exact"), std::hypot(.3, .4) / std::sqrt(2.),
              1e-14); // half of Ω each
}

TEST(Errors, of_fields_are_of_the_domain_alone)
{
  const auto scene = scene::parse_scene("test.prm", "",
                                        {{"Domain/mesh", "triangles"},
                                         {"Problem/solution", "x*y"},
                                         {"Methods/names", "fake"},
                                         {"Study/norms", "field Linf, field L2"},
                                         {"Study/decisive error", "field L2 | exact"}});
  const auto problem = make_problem(scene, 0, {.25, .5});
  Solution solution;
  solution.value = [](const dealii::Point<2> &x, unsigned int)
  {
    const bool is_inside = x[0] >= 0 && x[0] <= 1 && x[1] >= 0 && x[1] <= 1;
    return x[0] * x[1] + (is_inside ? .01 : 7);
  };
  const auto found = errors(scene.study.norms, problem, solution, {});
  EXPECT_NEAR(found.at("field Linf | exact"), .01, 1e-14);
  EXPECT_NEAR(found.at("field L2 | exact"), .01, 1e-13);
}

TEST(ErrorMap, shows_each_error_in_its_block_and_nothing_outside)
{
  const std::string holes = "subsection Domain\n set holes = 0.5, 0.5 : 1, 1\nend\n";
  for (const std::string decisive : {"nodal Linf | exact", "averages L2 | exact"})
  {
    const auto scene = make_scene(
        holes + "subsection Study\n set h = 0.125\n set decisive error = " + decisive + "\nend\n");
    const auto problem = make_problem(scene, 0, {.125, .25});
    auto solution = analysis::solve(FakeMethod(2), problem);
    const bool is_nodal = decisive[0] == 'n';
    (is_nodal ? solution.nodal : solution.averages)[8 + 2] += 7; // cell (2, 1)
    const auto map = error_map(scene.study.decisive_error.norm, problem, solution, {});
    EXPECT_EQ(map.quantity, is_nodal ? "nodal values" : "cell averages");
    ASSERT_EQ(map.n_x, 8u);
    ASSERT_EQ(map.values.size(), 64u);
    EXPECT_NEAR(map.values[8 + 2], is_nodal ? 7 + 1. / 64 : 7 - 1. / 64, 1e-12);
    EXPECT_NEAR(map.values[8 + 3], 1. / 64, 1e-12);
    EXPECT_TRUE(std::isnan(map.values[63]));
    const auto &u = is_nodal ? solution.nodal : solution.averages;
    ASSERT_EQ(map.solution.size(), 64u);
    for (const std::size_t cell : {8 + 2, 8 + 3})
      EXPECT_EQ(map.solution[cell], u[cell]);
    EXPECT_TRUE(std::isnan(map.solution[63]));
    EXPECT_EQ(map.n_components, 1u);
  }
}

TEST(BlockMeans, are_of_values_with_their_sign_or_of_magnitudes)
{
  const std::vector<double> u = {-3, 4, 6, 8};
  BlockMeans scalar(2), vector(1);
  for (const double &value : u)
    scalar.add(0, &value, 1);
  vector.add(0, &u[0], 2);
  vector.add(0, &u[2], 2);
  EXPECT_EQ(scalar.means()[0], 15. / 4);
  EXPECT_TRUE(std::isnan(scalar.means()[1]));
  EXPECT_EQ(vector.means()[0], 7.5); // of 5 and 10
}

TEST(Sweep, judges_checks_and_resumes)
{
  const std::string study =
      "subsection Study\n set regime = delta\n set m = 2, 3\n set h = 0.2, 0.1, 0.05, "
      "0.025\n set norms = nodal Linf\nend\nsubsection Expected\n set verdicts = fake: "
      "AC\n set rates = fake, m = 2: 2\n set errors = fake, m = 3: 4e-2 1e-2 2.5e-3 "
      "6.25e-4\n set bounds = fake: 1e-2\nend\n";
  const auto scene = make_scene(study);
  const auto good = std::make_shared<FakeMethod>(2);
  const Methods methods = {good};
  const StudyResults results = run_sweep(scene, methods, methods, at_cost());
  EXPECT_TRUE(results.is_complete);
  EXPECT_EQ(results.records.size(), 8u);
  ASSERT_EQ(results.trends.size(), 2u);
  EXPECT_EQ(results.trends[0].verdict, "AC");
  std::map<std::string, bool> holds;
  for (const Expectation &expectation : results.expectations)
    holds[expectation.subject] = expectation.holds;
  EXPECT_TRUE(holds.at("fake, u, m = 3: verdict"));
  EXPECT_TRUE(holds.at("fake, u, m = 2: rate of the last two levels"));
  EXPECT_TRUE(holds.at("fake, u, m = 3: errors"));
  EXPECT_FALSE(holds.at("fake, u, m = 2: largest error")); // .04 > .01

  // a sweep stopped after three solves goes on where it was
  unsigned int n_allowed = 3;
  SweepControl control = at_cost();
  control.should_stop = [&] { return n_allowed-- == 0; };
  const StudyResults partial = run_sweep(scene, methods, methods, control);
  EXPECT_FALSE(partial.is_complete);
  EXPECT_EQ(partial.records.size(), 3u);
  good->n_solves = 0;
  const StudyResults whole = run_sweep(scene, methods, methods, at_cost(), partial);
  EXPECT_EQ(good->n_solves, 5u);
  EXPECT_EQ(whole.records.size(), 8u);

  const Methods stalling = {std::make_shared<FakeMethod>(1, .01)};
  EXPECT_EQ(run_sweep(scene, stalling, stalling, at_cost()).trends[0].verdict, "not AC");
}

TEST(Sweep, unknown_methods_are_errors_that_name_the_known_ones)
{
  const Methods methods = {std::make_shared<FakeMethod>(2)};
  auto scene = make_scene();
  scene.methods.names = {"IPA"};
  try
  {
    (void)choose_methods(scene, methods);
    FAIL();
  }
  catch (const InputError &error)
  {
    EXPECT_STREQ(error.what(), "Methods/names: method 'IPA' is not known; choose one of fake");
  }
}

TEST(Sweep, data_that_are_not_finite_are_found_before_any_solve)
{
  EXPECT_THROW(check_data(make_scene("", "sqrt(x)")), InputError);
  EXPECT_NO_THROW(check_data(make_scene("", "sqrt(x + 1)")));
}
