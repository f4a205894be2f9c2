#include "meshfree/check/bond_check.h"
#include "base/error.h"
#include "meshfree/check/bond_file.h"
#include "meshfree/rules/rules.h"
#include "meshfree/scattered/operator.h"
#include "scene/problem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

using namespace plumbline;
using namespace plumbline::meshfree;

namespace
{
  constexpr double h = .125, m = 3;

  problem::Problem<2> make_problem(bool is_tensor)
  {
    const auto scene = scene::parse_scene(
        "check.prm", std::string("subsection Domain\n set mesh = squares\nend\nsubsection "
                                 "Methods\n set names = FA\nend\n") +
                         (is_tensor ? "subsection Kernel\n set type = bond-tensor\n set limit = "
                                      "Navier\nend\nsubsection Problem\n set solution = x, y\nend\n"
                                    : "subsection Problem\n set solution = x\nend\n"));
    return scene::make_problem(scene, 0, {h, m * h});
  }

  /// The families of all free nodes.
  std::vector<Family<2>> all(const NeighbourhoodQuadrature<2> &rule,
                             const problem::Problem<2> &problem)
  {
    const Families<2> families(rule, problem.kernel, *problem.cells(), Backend::fast);
    std::vector<Family<2>> result(families.size());
    for (std::size_t i = 0; i < families.size(); ++i)
      families.make(i, result[i]);
    return result;
  }

  std::vector<Family<2>> good_families(const problem::Problem<2> &problem)
  {
    return all(recalibrated(problem.kernel, 2), problem);
  }

  algebra::MatrixCheck check_matrix(const std::vector<Family<2>> &families,
                                    const problem::Problem<2> &problem)
  {
    return algebra::check_matrix(scattered_operator([&](std::size_t i, Family<2> &family)
                                                    { family = families[i]; },
                                                    problem, {0, families.size()})
                                     .rows.free);
  }

  /// The bond of a node to the one at a distance of (1, 0) h.
  Bond<2> &right_bond(Family<2> &family)
  {
    for (Bond<2> &bond : family.bonds)
      if (bond.xi.distance(Point<2>(h, 0)) < 1e-9)
        return bond;
    throw std::logic_error("no neighbour to the right");
  }

  constexpr std::size_t inner = 27; // row 3, column 3 of 8 x 8 free nodes

  std::string write(const std::string &name, const std::string &text)
  {
    const std::string file = ::testing::TempDir() + "bond_check_" + name;
    std::ofstream(file) << text;
    return file;
  }
} // namespace

TEST(CheckMoments, finds_what_partial_areas_miss)
{
  // C(m) - 1 at m = 3 for the scalar kernel, independent of h
  constexpr double expected = .091336;
  const auto problem = make_problem(false);
  const auto families = all(improved_partial_area(problem.kernel), problem);
  const MomentCheck check = check_moments(families, problem.kernel);
  EXPECT_NEAR(check.mean_ratio - 1, expected, 1e-6);
  EXPECT_NEAR(check.second.value, expected, 1e-6);
  EXPECT_NEAR(check.defects[1].worst.value, expected, 1e-6); // of ∫ C ξ1², as in what `run` says
  EXPECT_NEAR(check.defects[1].median, expected, 1e-6);
  EXPECT_EQ(check.exact_degree, 1);
  EXPECT_TRUE(check.is_first_exact());
  EXPECT_FALSE(check.is_second_exact());
}

TEST(CheckMoments, finds_recalibrated_weights_exact)
{
  for (const bool is_tensor : {false, true})
  {
    const auto problem = make_problem(is_tensor);
    const MomentCheck check = check_moments(good_families(problem), problem.kernel);
    EXPECT_NEAR(check.mean_ratio, 1, 1e-12);
    EXPECT_LT(check.second.value, 1e-12);
    EXPECT_EQ(check.exact_degree, 3); // the third by symmetry
    EXPECT_GT(check.defects[3].worst.value, 1e-3);
    EXPECT_TRUE(check.is_first_exact() && check.is_second_exact());
  }
}

TEST(CheckMoments, names_the_one_node_whose_weights_are_wrong)
{
  const auto problem = make_problem(false);
  auto families = good_families(problem);
  Bond<2> &bond = right_bond(families[inner]);
  const double change =
      2 * bond.weight * radial_value(problem.kernel, bond) * h * h / problem.kernel.moment({2, 0});
  bond.weight *= 3;
  MomentCheck check = check_moments(families, problem.kernel);
  EXPECT_FALSE(check.is_first_exact());
  EXPECT_EQ(check.defects[0].worst.node, inner);
  EXPECT_EQ(check.second.node, inner);
  EXPECT_NEAR(check.second.value, change, 1e-12);
  EXPECT_EQ(check.second_defects[inner], check.second.value);
  EXPECT_LT(check.typical(), 1e-12); // most nodes are right
  EXPECT_NEAR(check.mean_ratio - 1, change / 2 / 64, 1e-12);

  // errors that all nodes share are typical
  for (Family<2> &family : families)
    for (Bond<2> &each : family.bonds)
      each.weight *= 1.2;
  check = check_moments(families, problem.kernel);
  EXPECT_GT(check.typical(), .199);
  EXPECT_GT(check.second.value, .2);
}

TEST(CheckMoments, of_tensors_are_off_at_least_as_much_at_worst_as_on_average)
{
  const auto problem = make_problem(true);
  const MomentCheck check = check_moments(all(full_area(problem.kernel), problem), problem.kernel);
  EXPECT_GT(std::abs(check.mean_ratio - 1), 1e-3);
  EXPECT_GE(check.second.value, std::abs(check.mean_ratio - 1) - 1e-12);
}

// Kernel points mirrored at the x axis change the sign of C_12 and of nothing else: Σ w C_12 ξ1 ξ2
// = -∫ C_12 ξ1 ξ2, where the mean of cos² sin² is 1/8 and that of cos⁴, of ∫ C_11 ξ1², is 3/8.
TEST(CheckMoments, finds_mixed_entries_of_a_tensor_that_have_the_wrong_sign)
{
  const auto problem = make_problem(true);
  auto families = good_families(problem);
  for (Family<2> &family : families)
    for (Bond<2> &bond : family.bonds)
      bond.kernel_point[1] *= -1;
  const MomentCheck check = check_moments(families, problem.kernel);
  EXPECT_NEAR(check.mean_ratio, 1, 1e-12);
  EXPECT_LT(check.defects[0].worst.value, 1e-12);
  EXPECT_NEAR(check.defects[1].worst.value, 2. / 3, 1e-12);
  EXPECT_NEAR(check.second.value, 2. / 3, 1e-12);
  EXPECT_EQ(check.exact_degree, 1);
}

TEST(CheckMoments, refuses_a_kernel_without_a_local_limit)
{
  const auto problem = make_problem(false);
  // ∫ (1 - 5/4 t) t³ dt over (0, 1) is 0
  const Kernel<2> kernel(physics::Structure::scalar, {{1, 0}, {-1.25, 1}}, m * h, 1);
  EXPECT_THROW(check_moments(good_families(problem), kernel), InputError);
}

TEST(CheckWeights, partial_areas_add_up_to_the_ball)
{
  const auto problem = make_problem(false);
  auto families = all(improved_partial_area(problem.kernel), problem);
  for (Family<2> &family : families)
    for (std::size_t k = 0; k < family.bonds.size(); ++k)
      family.bonds[k].area = problem.cells()->area[family.neighbours[k]];
  const std::vector<double> volumes(64, h * h);
  WeightCheck check = check_weights(families, problem.kernel, volumes);
  EXPECT_LT(check.area.value, 1e-12);
  EXPECT_EQ(check.n_negative, 0u);
  EXPECT_NEAR(check.largest_ratio, 1, 1e-12);
  EXPECT_GT(check.smallest_ratio, 0);

  Bond<2> &bond = right_bond(families[inner]);
  bond.weight *= -2;
  check = check_weights(families, problem.kernel, volumes);
  EXPECT_EQ(check.n_negative, 1u);
  EXPECT_NEAR(check.smallest_ratio, -2, 1e-12);
  EXPECT_EQ(check.area.node, inner);
  EXPECT_NEAR(check.area.value, 3 / (M_PI * m * m), 1e-12);
}

TEST(CheckSymmetry, finds_an_asymmetric_weight_and_a_bond_without_partner)
{
  for (const bool is_tensor : {false, true})
  {
    const auto problem = make_problem(is_tensor);
    auto families = good_families(problem);
    const std::vector<double> volumes(families.size(), h * h);
    EXPECT_LT(check_symmetry(families, problem.kernel, volumes).asymmetry, 1e-12);
    right_bond(families[inner]).weight *= 1.01;
    SymmetryCheck check = check_symmetry(families, problem.kernel, volumes);
    EXPECT_NEAR(check.asymmetry, .01 / 1.01, 1e-9); // that bond is the largest
    EXPECT_NEAR(check.imbalance, .01 / 1.01, 1e-9);
    EXPECT_EQ(check.nodes[0] + check.nodes[1], 2 * inner + 1);
    EXPECT_EQ(check.n_unpaired, 0u);

    Family<2> &last = families[inner + 1];
    const auto left = std::find(last.neighbours.begin(), last.neighbours.end(), inner);
    last.bonds.erase(last.bonds.begin() + (left - last.neighbours.begin()));
    last.neighbours.erase(left);
    check = check_symmetry(families, problem.kernel, volumes);
    EXPECT_EQ(check.n_unpaired, 1u);
    EXPECT_NEAR(check.asymmetry, 1, 1e-9);
    EXPECT_EQ(check.nodes, (std::array<std::size_t, 2>{inner, inner + 1}));
  }
}

TEST(CheckSymmetry, forces_balance_where_weights_are_volumes)
{
  // w_ij = V_j: V_i w_ij = V_j w_ji though w_ij and w_ji differ
  const auto problem = make_problem(false);
  auto families = all(full_area(problem.kernel), problem);
  std::vector<double> volumes;
  for (std::size_t i = 0; i < problem.cells()->size(); ++i)
    volumes.push_back(h * h * (1 + .1 * static_cast<double>(i % 3)));
  for (Family<2> &family : families)
    for (std::size_t k = 0; k < family.bonds.size(); ++k)
      family.bonds[k].weight = volumes[family.neighbours[k]];
  const SymmetryCheck check = check_symmetry(families, problem.kernel, volumes);
  EXPECT_GT(check.asymmetry, .05);
  EXPECT_LT(check.imbalance, 1e-12);
}

TEST(CheckMatrix, finds_the_smallest_eigenvalue_of_a_known_matrix)
{
  // -1, 2, -1 moved by s: 2 - 2 cos(π / (n + 1)) + s and so on
  constexpr unsigned int n = 20;
  for (const double s : {0., -.1, -2.5})
  {
    algebra::CsrMatrix rows;
    rows.start = {0};
    for (unsigned int i = 0; i < n; ++i)
    {
      for (unsigned int j = i == 0 ? 0 : i - 1; j <= std::min(i + 1, n - 1); ++j)
      {
        rows.column.push_back(j);
        // the antisymmetric part has no part in it
        rows.value.push_back(i == j ? 2 + s : j > i ? -1.5 : -.5);
      }
      rows.start.push_back(rows.column.size());
    }
    const auto eigenvalue = [&](unsigned int k)
    { return 2 - 2 * std::cos(k * M_PI / (n + 1)) + s; };
    std::size_t n_negative = 0;
    for (unsigned int k = 1; k <= n; ++k)
      n_negative += eigenvalue(k) < 0 ? 1 : 0;
    const algebra::MatrixCheck check = algebra::check_matrix(rows);
    EXPECT_NEAR(check.smallest_eigenvalue, eigenvalue(1), 1e-6 * std::abs(eigenvalue(1))) << s;
    EXPECT_EQ(check.n_negative_eigenvalues, n_negative);
    EXPECT_EQ(check.is_positive_definite(), s == 0);
    EXPECT_EQ(check.n_positive, 0u);
    EXPECT_EQ(check.n_weak, s == 0 ? 0u : s == -.1 ? n - 2 : n);
  }
}

TEST(CheckMatrix, finds_a_matrix_that_is_not_definite)
{
  for (const bool is_tensor : {false, true})
  {
    const auto problem = make_problem(is_tensor);
    auto families = good_families(problem);
    algebra::MatrixCheck check = check_matrix(families, problem);
    EXPECT_TRUE(check.is_positive_definite());
    EXPECT_GT(check.smallest_eigenvalue, 0);
    if (!is_tensor)
    {
      EXPECT_EQ(check.n_positive + check.n_weak, 0u);
    }

    for (Bond<2> &bond : families[inner].bonds) // one row of the wrong sign
      bond.weight *= -1;
    check = check_matrix(families, problem);
    EXPECT_FALSE(check.is_positive_definite());
    EXPECT_EQ(check.n_negative_eigenvalues, is_tensor ? 2u : 1u);
    EXPECT_LT(check.smallest_eigenvalue, 0);
    EXPECT_GE(check.n_weak, 1u);
    EXPECT_GE(check.n_positive, 1u);
  }
}

TEST(GivenFamilies, are_read_in_any_order_of_rows_and_columns)
{
  const auto problem = make_problem(false);
  // two nodes in the domain, one in the collar; an empty kernel point is the neighbour's node
  const GivenNodes<2> nodes =
      read_given_nodes<2>(write("nodes.csv", "y,volume,colour,x,id\n.5,.25,red,.75,9\n\n"
                                             ".5,.2,blue,-.125,-3\n.5, .3 ,red,.25,4\r\n"));
  EXPECT_EQ(nodes.id, (std::vector<std::int64_t>{9, -3, 4}));
  EXPECT_EQ(nodes.line, (std::vector<std::size_t>{2, 4, 5}));
  EXPECT_EQ(nodes_inside(nodes, *problem.mesh()), (std::vector<std::size_t>{0, 2}));
  const auto cells = geometry::voronoi_cells(nodes.places, *problem.mesh());
  const GivenFamilies<2> given = read_given_families(
      write("bonds.csv", "j,i,weight,qx,qy\n4,9,.1,-.4,0\n9,-3,1,,\n9,4,-2e-1,,\n-3,4,3,,\n"),
      nodes, cells);
  EXPECT_EQ(given.n_ignored, 1u);
  ASSERT_EQ(given.families.size(), 2u);
  ASSERT_EQ(given.families[0].bonds.size(), 1u);
  EXPECT_EQ(given.families[0].bonds[0].kernel_point, Point<2>(-.4, 0));
  EXPECT_EQ(given.families[0].bonds[0].xi, Point<2>(-.5, 0));
  EXPECT_EQ(given.families[0].bonds[0].area, .3);
  EXPECT_EQ(given.families[1].neighbours, (std::vector<unsigned int>{0, 2}));
  EXPECT_EQ(given.families[1].bonds[0].weight, -.2);
  EXPECT_EQ(given.families[1].bonds[0].kernel_point, Point<2>(.5, 0));
  EXPECT_EQ(given.families[1].bonds[1].weight, 3);
}
