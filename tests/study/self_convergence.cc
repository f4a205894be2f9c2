// Methods held against themselves, and scenes against themselves: averages carried from level to
// level, and solutions that contradict their loads.
#include "study/self_convergence.h"
#include "scene/problem.h"

#include "scene/scene.h"
#include "study/comparison.h"
#include "study/contradiction.h"
#include "tests/study/space_scene.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::study;

namespace
{
  problem::Problem<2> problem_of(const std::string &sections, double h, double m = 2)
  {
    return make_problem(scene::parse_scene("test.prm", sections), 0, {h, m * h});
  }

  std::string domain(const std::string &mesh, const std::string &nodes,
                     const std::string &more = "")
  {
    return "subsection Domain\n set boxes = 0, 0 : 2, 1\n set mesh = " + mesh + "\n" + more +
           "\nend\nsubsection Methods\n set names = FA\n set nodes = " + nodes + "\nend\n";
  }

  const std::string field = "subsection Problem\n set solution = x^3 + y^2*x\nend\n";
} // namespace

TEST(SelfConvergence, averages_over_nested_cells_are_means_of_their_parts)
{
  for (const std::string mesh : {"lattice", "squares"})
  {
    const auto fine = problem_of(domain(mesh, "centres") + field, .125),
               coarse = problem_of(domain(mesh, "centres") + field, .25);
    const auto moved = transferred_averages(
        comparison_pieces(fine), cell_averages(*fine.solution, fine), comparison_pieces(coarse), 1);
    const auto exact = cell_averages(*coarse.solution, coarse);
    ASSERT_EQ(moved.size(), exact.size());
    for (std::size_t i = 0; i < exact.size(); ++i)
      EXPECT_NEAR(moved[i], exact[i], 1e-13) << mesh << i;
  }
}

// the finest level of DGQ0 as a reference for all levels
TEST(SelfConvergence, a_reference_of_one_mesh_size_is_a_finest_level)
{
  using in_space::with;
  const in_space::Settings of_levels = {
      {"Kernel/type", "linear-decay"}, {"Kernel/limit", "-1/2 Laplace"},
      {"Problem/load", "x"},           {"Problem/solution", ""},
      {"Problem/constraint", "0"},     {"Problem/local solution", "none"},
      {"Methods/names", "FA, DGQ0"},   {"Study/regime", "m"},
      {"Study/h", "0.25, 0.1"},        {"Study/horizon", "0.5"},
      {"Study/norms", "averages L2"},  {"Study/decisive error", "averages L2 | own finest level"}};
  const auto scene = [](const in_space::Settings &settings)
  { return scene::parse_scene("test.prm", "", settings); };
  const Records own = in_space::run(scene(of_levels)).records,
                fixed = in_space::run(scene(with(of_levels, {{"Reference/method", "DGQ0"},
                                                             {"Reference/mesh size", "0.1"},
                                                             {"Reference/estimate", "none"},
                                                             {"Study/decisive error",
                                                              "averages L2 | reference"}})))
                            .records;
  ASSERT_EQ(own.size(), 4u);
  ASSERT_EQ(fixed.size(), 4u);
  for (std::size_t i = 0; i < own.size(); ++i)
    if (const bool is_finest = own[i].key.level == 1; !is_finest)
    {
      const double distance = own[i]["L2 distance to the finest DGQ0"];
      EXPECT_GT(distance, 1e-3);
      EXPECT_NEAR(fixed[i][distance_to_reference], distance, 1e-12);
      if (own[i].key.method == "DGQ0")
        EXPECT_NEAR(fixed[i]["averages L2 | reference"], own[i]["averages L2 | own finest level"],
                    1e-12);
    }
    else if (own[i].key.method == "DGQ0")
      EXPECT_LT(fixed[i][distance_to_reference], 1e-8); // the root of what areas are rounded by
}

TEST(SelfConvergence, any_cells_keep_integrals_and_components_apart)
{
  // 7 and 5 cells a side, moved at random: nothing is nested
  const std::string text = domain("squares", "centres", "") +
                           "subsection Kernel\n set type = bond-tensor\n set limit = Navier\nend\n"
                           "subsection Problem\n set solution = 3, x\nend\n";
  auto moved_nodes = text;
  moved_nodes.replace(moved_nodes.find("nodes = centres"), 15,
                      "nodes = centres\n set perturbation = 0.3");
  const auto fine = problem_of(moved_nodes, 1. / 7), coarse = problem_of(moved_nodes, .2);
  const auto from = comparison_pieces(fine), to = comparison_pieces(coarse);
  const auto averages = cell_averages(*fine.solution, fine);
  const auto moved = transferred_averages(from, averages, to, 2);
  double before = 0, after = 0;
  for (std::size_t i = 0; i < from.area.size(); ++i)
    before += from.area[i] * averages[2 * i + 1];
  for (std::size_t i = 0; i < to.area.size(); ++i)
  {
    EXPECT_NEAR(moved[2 * i], 3, 1e-12);
    after += to.area[i] * moved[2 * i + 1];
  }
  EXPECT_NEAR(after, before, 1e-11);
  EXPECT_NEAR(after, 2, 1e-11); // ∫ x over the domain
}

TEST(SelfConvergence, fields_are_0_beyond_their_cells)
{
  const auto square = [](double left, double side) {
    return geometry::Polygon{{left, 0}, {left + side, 0}, {left + side, side}, {left, side}};
  };
  const CellPieces one{{square(0, 2)}, {0}, {4}}, other{{square(1, 1)}, {0}, {1}};
  // 3 on the one, but -1 on what they share; then 3 against 0
  EXPECT_NEAR(distance_across(one, {3}, other, {4}, 1), std::sqrt(1. + 9 * 3), 1e-13);
  EXPECT_NEAR(distance_across(other, {4}, one, {3}, 1), std::sqrt(1. + 9 * 3), 1e-13);
}

TEST(SelfConvergence, every_level_is_held_against_the_last_one_of_the_same_method_and_series)
{
  const scene::Scene scene = scene::parse_scene(
      "test.prm", domain("lattice", "centres") + field +
                      "subsection Study\n set regime = delta\n set m = 2\n set h = 0.5, 0.25\n set "
                      "norms = averages Linf, averages L2\n set decisive error = averages L2 | own "
                      "finest level\nend\n");
  OwnFinest own;
  std::vector<study::Record> runs;
  for (const std::string method : {"A", "B"})
    for (unsigned int level = 0; level < 2; ++level)
    {
      const problem::Problem<2> problem =
          make_problem(scene, 0, scene.study.series[0].levels[level]);
      study::Record run;
      run.key.method = method;
      run.key.problem = "u";
      run.key.series = scene.study.series[0].name;
      run.key.level = level;
      run.key.h = problem.h;
      const double value = method == "A" ? 1. + level : 5. + 3 * level;
      own.keep(run, problem, std::vector<double>(level == 0 ? 8 : 32, value));
      runs.push_back(run);
    }
  own.compare(scene, runs);
  EXPECT_NEAR(runs[0]["averages Linf | own finest level"], 1, 1e-13);
  EXPECT_NEAR(runs[0]["averages L2 | own finest level"], std::sqrt(2.), 1e-13);
  EXPECT_NEAR(runs[2]["averages Linf | own finest level"], 3, 1e-13);
  // of each from the finest of both: 1, 5 at the coarse level, 2, 8 at the fine one, over an area
  // of 2
  EXPECT_NEAR(runs[0]["L2 distance to the finest A"], std::sqrt(2.), 1e-13);
  EXPECT_NEAR(runs[0]["L2 distance to the finest B"], 7 * std::sqrt(2.), 1e-12);
  EXPECT_NEAR(runs[2]["L2 distance to the finest A"], 3 * std::sqrt(2.), 1e-13);
  EXPECT_TRUE(runs[1].scalars.empty());
  EXPECT_TRUE(runs[3].scalars.empty());
}

namespace
{
  std::optional<Contradiction> contradiction(const std::string &text, double h = .05)
  {
    const scene::Scene scene = scene::parse_scene("test.prm", text);
    return measure_contradiction(make_problem(scene, 0, {h, 3 * h}));
  }

  std::string problem_section(const std::string &solution, const std::string &load)
  {
    return "subsection Problem\n set solution = " + solution + "\n set load = " + load + "\nend\n";
  }

  const std::string laplace =
      "subsection Kernel\n set type = constant\n set limit = -Laplace\nend\n";

  /// An LPS plate of ν = 1/4 that a crack may cut.
  std::string plate(const std::string &crack, const std::string &solution)
  {
    return domain("squares", "centres", crack) +
           "subsection Kernel\n set type = 1/r\n set limit = Navier\nend\nsubsection Material\n "
           "set "
           "model = LPS\n set E = 1\n set nu = 0.25\nend\n" +
           problem_section(solution, "0, 0");
  }
} // namespace

TEST(Contradiction, is_seen_where_a_load_is_not_that_of_its_solution)
{
  // quadratic fields have the same load for every horizon: -Laplace of x² is -2
  const auto fits =
      contradiction(domain("lattice", "centres") + laplace + problem_section("x^2 + y", "-2"));
  ASSERT_TRUE(fits);
  EXPECT_FALSE(fits->is_clear()) << fits->text();
  EXPECT_NEAR(fits->of_operator, 2, 1e-9);
  const auto half =
      contradiction(domain("lattice", "centres") + laplace + problem_section("x^2 + y", "-1"));
  ASSERT_TRUE(half);
  EXPECT_TRUE(half->is_clear());
  EXPECT_NEAR(half->difference, 1, 1e-9);
  EXPECT_NEAR(half->load, 1, 1e-9);
  EXPECT_FALSE(contradiction(domain("lattice", "centres") + laplace + field)); // none is given
}

TEST(Contradiction, a_crack_contradicts_a_field_that_does_not_open_it)
{
  const std::string crack = " set cracks = 0, 0.5 : 1, 0.5";
  const auto uncut = contradiction(plate("", "0, y"));
  ASSERT_TRUE(uncut);
  EXPECT_FALSE(uncut->is_clear()) << uncut->text();
  const auto cut = contradiction(plate(crack, "0, y"));
  ASSERT_TRUE(cut);
  EXPECT_TRUE(cut->is_clear()) << cut->text();
  EXPECT_NEAR(cut->where[1], .5, .11); // near the crack
  // a crack does nothing to what moves as a whole
  const auto rigid = contradiction(plate(crack, "1, 2"));
  ASSERT_TRUE(rigid);
  EXPECT_FALSE(rigid->is_clear()) << rigid->text();
}
