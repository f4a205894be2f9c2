// The linear peridynamic solid by the optimisation-based rule against exact local solutions.
#include "tests/meshfree/state_based_problems.h"

#include <gtest/gtest.h>

using namespace plumbline;
using namespace plumbline::meshfree;

namespace
{
  double error(const StateBasedProblem &problem, const Square &square)
  {
    const StateBasedCase one(problem, square);
    return one.l2_error(solve(one.system(), algebra::SparseSolver::automatic, 2).values);
  }

  /// Errors at 8, 16, ... cells a unit, to the digits of those expected.
  void expect_errors(const StateBasedProblem &problem, double unit, double offset,
                     const std::vector<double> &expected, double digits)
  {
    unsigned int n = 8;
    for (const double value : expected)
    {
      EXPECT_NEAR(error(problem, Square(unit / n, unit / 2, offset)) / value, 1, digits)
          << "n = " << n;
      n *= 2;
    }
  }

  /// Stretched along surfaces y = const that are free of traction: linear, of uniaxial stress.
  StateBasedProblem stretched(double nu)
  {
    const Lame lame = plane_strain(1, nu);
    return {[=](const Point<2> &) { return lame; },
            [=](const Point<2> &x)
            { return Point<2>(x[0], -lame.lambda / (lame.lambda + 2 * lame.mu) * x[1]); },
            no_load,
            {},
            true,
            true};
  }

  /// The system in (u, θ), solved with θ = 0 for all nodes of the collar.
  std::vector<double> solve_without_collar_dilatation(const StateBasedCase &one)
  {
    auto system = one.system(true);
    algebra::CsrMatrix &rows = system.rows;
    for (std::size_t row = 3 * one.square.cells.n_free; row < rows.n_rows(); ++row)
    {
      system.right_hand_side[row] = 0;
      for (std::size_t k = rows.start[row]; k < rows.start[row + 1]; ++k)
        rows.value[k] = rows.column[k] == row ? 1 : 0;
    }
    return solve(system).values;
  }
} // namespace

// The numbers are those of an independent prototype of the same scheme, to its printed digits.
TEST(LinearPeridynamicSolid, smooth_solutions_converge_at_second_order)
{
  expect_errors(smooth_problem(.3), 1, 0, {2.628e-3, 5.822e-4, 1.374e-4}, 5e-4);
  expect_errors(smooth_problem(.495), 1, 0, {1.851e-2, 2.883e-3, 5.655e-4}, 5e-4);
}

TEST(LinearPeridynamicSolid, interfaces_between_nodes_converge)
{
  expect_errors(interface_problem(.3), M_PI, .5, {3.09e-2, 1.14e-2, 4.35e-3, 1.74e-3}, 5e-3);
  expect_errors(interface_problem(.495), M_PI, .5, {3.08e-1, 1.00e-1, 3.38e-2, 1.16e-2}, 5e-3);
}

TEST(LinearPeridynamicSolid, cracks_between_two_materials_converge)
{
  expect_errors(interface_crack_problem(.3), M_PI, .5, {6.9e-2, 3.9e-2, 2.3e-2, 1.34e-2}, .02);
}

// Without θ in the collar the error is of first order, and large for nearly incompressible solids.
TEST(LinearPeridynamicSolid, needs_dilatations_in_the_collar)
{
  const Square square(1. / 32, .5, 0);
  for (const auto &[nu, expected] : {std::pair(.3, 3.5e-3), std::pair(.495, .21)})
  {
    const auto problem = smooth_problem(nu);
    const StateBasedCase one(problem, square);
    EXPECT_NEAR(one.l2_error(solve_without_collar_dilatation(one)) / expected, 1, .02);
  }
}

TEST(LinearPeridynamicSolid, counts_dilatations_of_the_collar_as_zero_where_it_is_told_to)
{
  const Square square(1. / 8, .5, 0);
  const auto problem = smooth_problem(.3);
  StateBasedCase one(problem, square);
  const auto expected = solve_without_collar_dilatation(one);
  one.body.has_collar_dilatation = false;
  for (const bool keeps_dilatation : {false, true})
  {
    const auto system = one.system(keeps_dilatation);
    ASSERT_EQ(system.rows.n_rows(), (keeps_dilatation ? 3 : 2) * square.cells.n_free);
    const auto found = solve(system).values;
    for (std::size_t i = 0; i < 2 * square.cells.n_free; ++i)
      EXPECT_NEAR(found[i], expected[i], 1e-12) << keeps_dilatation; // displacements up to 1
  }
}

TEST(LinearPeridynamicSolid, uniaxial_stress_along_a_free_surface_is_exact_with_its_terms_alone)
{
  const Square square(M_PI / 8, M_PI / 2, .5);
  for (const double nu : {.3, .495})
  {
    auto crack = stretched(nu), surface = stretched(nu);
    crack.damage.cracks = {{Point<2>(-9, .02), Point<2>(9, .02)}};
    for (const Point<2> &x : square.cells.nodes)
      surface.damage.is_ghost.push_back(x[1] > M_PI / 2);
    for (StateBasedProblem *problem : {&crack, &surface})
    {
      EXPECT_LT(error(*problem, square), 1e-12) << nu;
      problem->damage.surface_terms = problem::SurfaceTerms::none;
      EXPECT_GT(error(*problem, square), 1e-3) << nu;
    }
  }
}
