// The system in (u, θ) of the linear peridynamic solid, iterated with multigrid on u's own block.
#include "tests/meshfree/state_based_problems.h"

#include <gtest/gtest.h>

using namespace plumbline;
using namespace plumbline::meshfree;

namespace
{
  algebra::SparseSolution iterate(const StateBasedCase &one, algebra::Iteration iteration)
  {
    const auto system = one.system(true);
    algebra::SparseOptions options;
    options.is_symmetric = false;
    options.solver = algebra::SparseSolver::amg;
    options.iteration = iteration;
    options.n_components = 2;
    options.n_first = 2 * one.square.cells.n_free;
    const auto &nodes = one.square.cells.nodes;
    options.nodes.assign(nodes.begin(),
                         nodes.begin() + static_cast<std::ptrdiff_t>(one.square.cells.n_free));
    return algebra::solve_sparse(system.rows, system.right_hand_side, options,
                                 base::Communicator::alone());
  }

  unsigned int n_iterations(const StateBasedProblem &problem, const Square &square)
  {
    return iterate({problem, square}, algebra::Iteration::gmres).n_iterations;
  }

  /// max |a - b| / max |a| over the displacements a.
  double difference(const std::vector<double> &a, const std::vector<double> &b)
  {
    double largest = 0, defect = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
    {
      largest = std::max(largest, std::abs(a[i]));
      defect = std::max(defect, std::abs(a[i] - b[i]));
    }
    return defect / largest;
  }

  StateBasedProblem with_free_surface(const Square &square)
  {
    auto problem = smooth_problem(.3);
    for (const Point<2> &x : square.cells.nodes)
      problem.damage.is_ghost.push_back(x[1] > M_PI / 2);
    return problem;
  }
} // namespace

// 2592 displacements: above the 2000 that multigrid does not coarsen.
TEST(KeptDilatation, iterations_yield_what_elimination_yields)
{
  const Square square(M_PI / 36, M_PI / 2, .5);
  for (const StateBasedProblem &problem : {smooth_problem(.2), interface_problem(.495),
                                           interface_crack_problem(.3), with_free_surface(square)})
  {
    const StateBasedCase one(problem, square);
    const auto eliminated = solve(one.system(), algebra::SparseSolver::amg, 2).values;
    for (const auto iteration : {algebra::Iteration::gmres, algebra::Iteration::bicgstab})
    {
      const auto kept = iterate(one, iteration);
      EXPECT_LT(difference(eliminated, kept.values), 1e-10) << kept.solver;
    }
  }
}

TEST(KeptDilatation, iterations_yield_the_direct_solution_dilatations_included)
{
  const Square square(M_PI / 16, M_PI / 2, .5);
  const auto problem = interface_crack_problem(.495);
  const StateBasedCase one(problem, square);
  const auto direct = solve(one.system(true)).values;
  for (const auto iteration : {algebra::Iteration::gmres, algebra::Iteration::bicgstab})
    EXPECT_LT(difference(direct, iterate(one, iteration).values), 1e-10);
}

// Measured: 7, 14, 17 and 69, 90, 104. (Up to 2000 displacements multigrid is a direct solver.)
TEST(KeptDilatation, iterations_are_bounded_however_fine_the_nodes_are)
{
  for (const auto &[nu, bound] : {std::pair(.3, 19u), std::pair(.495, 110u)})
    for (const int n : {32, 64, 128})
      EXPECT_LE(n_iterations(smooth_problem(nu), Square(1. / n, .5, 0)), bound) << nu << ' ' << n;
}

// Measured: 14, 15, 12 and 23.
TEST(KeptDilatation, interfaces_cracks_wide_horizons_and_moved_nodes_cost_few_iterations_more)
{
  const Square square(M_PI / 64, M_PI / 2, .5), wide(1. / 48, .5, 0, 6);
  Square moved(1. / 64, .5, 0);
  for (std::size_t i = 0; i < moved.cells.size(); ++i)
    moved.cells.nodes[i] += .2 * moved.h * Point<2>(std::sin(5. * i), std::cos(7. * i));
  EXPECT_LE(n_iterations(interface_problem(.3), square), 17u);
  EXPECT_LE(n_iterations(interface_crack_problem(.3), square), 17u);
  EXPECT_LE(n_iterations(smooth_problem(.3), wide), 14u);
  EXPECT_LE(n_iterations(smooth_problem(.3), moved), 26u);
}

// The condition is (λ + 2μ) / (3μ), that of both solids' stiffness in compression: 3.7 and 34.
TEST(KeptDilatation, iterations_grow_with_the_root_of_lambda_over_mu)
{
  const Square square(1. / 32, .5, 0);
  const double ratio = static_cast<double>(n_iterations(smooth_problem(.495), square)) /
                       n_iterations(smooth_problem(.45), square);
  EXPECT_NEAR(ratio, 3, 1); // √(34 / 3.7)
}
