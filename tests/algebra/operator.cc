#include "algebra/operator.h"

#include "algebra/solve.h"
#include "algebra/sparse.h"
#include "base/error.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/vector.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace plumbline;
using namespace plumbline::algebra;
using geometry::AxisSpecies;
using geometry::Domain;
using geometry::Lattice;
using geometry::NodeSet;

namespace
{
  const Domain square{{{{0, 0}, {1, 1}}}, {}};
  const Domain l_shape{{{{0, 0}, {1, 1}}}, {{{.5, .5}, {1, 1}}}};
  const std::vector<AxisSpecies> one_family = {{.5, false, 0}};
  const std::vector<AxisSpecies> two_families = {{0, true, 0}, {.5, false, 1}};

  /// A random positive definite stencil: like a graph Laplacian with symmetric blocks.
  Stencil random_stencil(unsigned int n_blocks, int reach, bool is_even)
  {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(.1, 1);
    Stencil stencil(n_blocks, reach);
    for (unsigned int s = 0; s < n_blocks; ++s)
      for (unsigned int t = 0; t <= s; ++t)
        for (int k2 = -reach; k2 <= reach; ++k2)
          for (int k1 = -reach; k1 <= reach; ++k1)
          {
            const double w = -uniform(random) * (s == t ? 1 : .3);
            stencil(s, t, k1, k2) = stencil(t, s, -k1, -k2) = w;
            if (is_even)
              stencil(s, t, -k1, -k2) = stencil(t, s, k1, k2) = w;
          }
    double total = 0;
    for (unsigned int s = 0; s < n_blocks; ++s)
      for (unsigned int t = 0; t < n_blocks; ++t)
        for (int k2 = -reach; k2 <= reach; ++k2)
          for (int k1 = -reach; k1 <= reach; ++k1)
            total += std::abs(stencil(s, t, k1, k2));
    for (unsigned int s = 0; s < n_blocks; ++s)
      stencil(s, s, 0, 0) = total;
    return stencil;
  }

  Vector random_vector(const NodeSet &nodes)
  {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Vector v(nodes.size());
    for (std::size_t i = 0; i < v.size(); ++i)
      v[i] = nodes.is_free[i % nodes.is_free.size()] != 0 ? uniform(random) : 0;
    return v;
  }

  double relative_difference(const Stencil &stencil, const NodeSet &nodes, OperatorBackend a,
                             OperatorBackend b)
  {
    const Vector input = random_vector(nodes);
    Vector x(nodes.size()), y(nodes.size());
    make_operator(stencil, nodes, a)->vmult(x, input);
    make_operator(stencil, nodes, b)->vmult(y, input);
    const double size = x.linfty_norm();
    x -= y;
    return x.linfty_norm() / size;
  }
} // namespace

TEST(Operator, fft_direct_and_sparse_roads_agree_for_one_and_two_components)
{
  for (const Domain &domain : {square, l_shape})
    for (const unsigned int n_components : {1u, 2u})
      for (const int reach : {1, 3, 9})
      {
        const NodeSet nodes = free_nodes(Lattice(domain, 1. / 16), one_family, n_components);
        const Stencil stencil = random_stencil(n_components, reach, true);
        EXPECT_LT(
            relative_difference(stencil, nodes, OperatorBackend::sparse, OperatorBackend::fft),
            1e-13);
        EXPECT_LT(
            relative_difference(stencil, nodes, OperatorBackend::sparse, OperatorBackend::direct),
            1e-13);
      }
}

TEST(Operator, reach_beyond_the_domain_is_allowed)
{
  const NodeSet nodes = free_nodes(Lattice(square, .25), one_family, 1);
  const Stencil stencil = random_stencil(1, 6, true);
  EXPECT_LT(relative_difference(stencil, nodes, OperatorBackend::sparse, OperatorBackend::fft),
            1e-13);
  EXPECT_LT(relative_difference(stencil, nodes, OperatorBackend::sparse, OperatorBackend::direct),
            1e-13);
}

TEST(Operator, fft_and_sparse_roads_agree_for_several_families)
{
  for (const Domain &domain : {square, l_shape})
  {
    const NodeSet nodes = free_nodes(Lattice(domain, .125), two_families, 2);
    const Stencil stencil = random_stencil(8, 2, false);
    EXPECT_LT(relative_difference(stencil, nodes, OperatorBackend::sparse, OperatorBackend::fft),
              1e-13);
  }
}

TEST(Operator, direct_road_is_refused_where_it_does_not_fit)
{
  const NodeSet nodes = free_nodes(Lattice(square, .25), two_families, 1);
  EXPECT_THROW(make_operator(random_stencil(4, 1, false), nodes, OperatorBackend::direct),
               InputError);
}

TEST(Operator, automatic_takes_the_direct_road_for_short_reach_and_transforms_for_long_reach)
{
  const NodeSet nodes = free_nodes(Lattice(square, 1. / 128), one_family, 1);
  EXPECT_EQ(make_operator(random_stencil(1, 2, true), nodes)->backend(), "direct");
  EXPECT_EQ(make_operator(random_stencil(1, 30, true), nodes)->backend(), "fft");
}

TEST(CollarAction, equals_the_sum_over_given_neighbours)
{
  const NodeSet nodes = free_nodes(Lattice(l_shape, .125), one_family, 1);
  const int reach = 3;
  const Stencil stencil = random_stencil(1, reach, true);
  const int width = nodes.n[0] + 2 * reach;
  const auto g = [](int i, int j) { return std::sin(i + .3 * j); };
  std::vector<double> data;
  for (int j = -reach; j < nodes.n[1] + reach; ++j)
    for (int i = -reach; i < nodes.n[0] + reach; ++i)
      data.push_back(nodes.free(0, i, j) ? 0 : g(i, j));
  ASSERT_EQ(data.size(), static_cast<std::size_t>(width * width));

  const Vector action = collar_action(stencil, nodes, data);
  for (int j = 0; j < nodes.n[1]; ++j)
    for (int i = 0; i < nodes.n[0]; ++i)
    {
      double sum = 0;
      for (int k2 = -reach; k2 <= reach && nodes.free(0, i, j); ++k2)
        for (int k1 = -reach; k1 <= reach; ++k1)
          if (!nodes.free(0, i + k1, j + k2))
            sum += stencil(0, 0, k1, k2) * g(i + k1, j + k2);
      EXPECT_NEAR(action[j * nodes.n[0] + i], sum, 1e-12);
    }
}

TEST(Solve, preconditioned_and_direct_solutions_agree)
{
  for (const Domain &domain : {square, l_shape})
    for (const auto &families : {one_family, two_families})
    {
      const Lattice lattice(domain, .125);
      const NodeSet nodes = free_nodes(lattice, families, 1);
      const Stencil stencil = random_stencil(nodes.n_blocks(), 2, nodes.n_blocks() == 1);
      const SparseOperator sparse(stencil, nodes);
      const Vector right_hand_side = random_vector(nodes);
      Vector direct(nodes.size()), iterative(nodes.size());
      sparse.solve_directly(direct, right_hand_side);
      const SchwarzPreconditioner preconditioner(stencil, nodes, maximal_rectangles(lattice));
      solve(*make_operator(stencil, nodes), preconditioner, iterative, right_hand_side, 1e-13, 200);
      iterative -= direct;
      EXPECT_LT(iterative.linfty_norm(), 1e-12 * direct.linfty_norm());
    }
}

namespace
{
  /// Where a value outside 0..n-1 continues one inside, and its sign; 0 on the node next to a side
  /// of zeros.
  std::pair<int, double> continued(int i, int n, const std::array<Side, 2> &sides)
  {
    double sign = 1;
    while (i < 0 || i >= n)
    {
      const bool upper = i >= n, is_zero = sides[upper] == Side::zero;
      const int about = upper ? n - !is_zero : -is_zero;
      if (i == about)
        return {0, 0};
      i = 2 * about - i;
      sign *= is_zero ? -1 : 1;
    }
    return {i, sign};
  }
} // namespace

TEST(SineSolver, inverts_an_even_operator_between_zeros_and_mirrors)
{
  const std::array<int, 2> n{7, 6};
  const NodeSet nodes{one_family, 1, n, std::vector<char>(n[0] * n[1], 1)};
  Stencil stencil(1, 2);
  for (int k2 = -2; k2 <= 2; ++k2)
    for (int k1 = -2; k1 <= 2; ++k1)
      stencil(0, 0, k1, k2) = k1 == 0 && k2 == 0 ? 9 : -1. / (1 + k1 * k1 + 2 * k2 * k2);
  const std::vector<std::array<Side, 2>> all = {{Side::zero, Side::zero},
                                                {Side::zero, Side::mirrored},
                                                {Side::mirrored, Side::zero},
                                                {Side::mirrored, Side::mirrored}};
  const Vector u = random_vector(nodes);
  for (const auto &along : all)
    for (const auto &across : all)
    {
      Vector f(u.size()), inverse(u.size());
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i)
        {
          for (int k2 = -2; k2 <= 2; ++k2)
            for (int k1 = -2; k1 <= 2; ++k1)
            {
              const auto [p, sign_p] = continued(i + k1, n[0], along);
              const auto [q, sign_q] = continued(j + k2, n[1], across);
              f[j * n[0] + i] += stencil(0, 0, k1, k2) * sign_p * sign_q * u[q * n[0] + p];
            }
          for (const bool upper : {false, true}) // half cells
          {
            if (along[upper] == Side::mirrored && i == upper * (n[0] - 1))
              f[j * n[0] + i] /= 2;
            if (across[upper] == Side::mirrored && j == upper * (n[1] - 1))
              f[j * n[0] + i] /= 2;
          }
        }
      make_sine_solver(stencil, nodes, {{0, 0}, n}, {along, across})->add_inverse(inverse, f);
      inverse -= u;
      EXPECT_LT(inverse.linfty_norm(), 1e-14);
    }
}

TEST(Solve, an_operator_that_is_not_positive_definite_is_an_error)
{
  const Lattice lattice(square, .125);
  const NodeSet nodes = free_nodes(lattice, one_family, 1);
  Stencil stencil = random_stencil(1, 2, true);
  stencil(0, 0, 0, 0) = -1;
  EXPECT_THROW(SchwarzPreconditioner(stencil, nodes, maximal_rectangles(lattice)), NumericalError);
}

TEST(Solve, says_the_residual_that_it_leaves_relative_to_the_right_hand_side)
{
  const Lattice lattice(square, 1. / 16);
  const NodeSet nodes = free_nodes(lattice, one_family, 1);
  Stencil laplace(1, 1);
  laplace(0, 0, 0, 0) = 4;
  laplace(0, 0, 1, 0) = laplace(0, 0, -1, 0) = laplace(0, 0, 0, 1) = laplace(0, 0, 0, -1) = -1;
  const auto matrix = make_operator(laplace, nodes);
  for (const double size : {1., 1e6})
  {
    Vector right_hand_side = random_vector(nodes), solution(nodes.size()), residual(nodes.size());
    right_hand_side *= size;
    const SolveResult found = solve(*matrix, solution, right_hand_side, 1e-6, 500);
    matrix->vmult(residual, solution);
    residual -= right_hand_side;
    const double relative = residual.l2_norm() / right_hand_side.l2_norm();
    EXPECT_LE(relative, 1e-6);
    EXPECT_NEAR(found.relative_residual, relative, 1e-3 * relative); // it is updated, not computed
  }
}

TEST(Solve, too_few_iterations_are_an_error_with_the_residual)
{
  const Lattice lattice(square, 1. / 64);
  const NodeSet nodes = free_nodes(lattice, one_family, 1);
  Stencil laplace(1, 1);
  laplace(0, 0, 0, 0) = 4;
  laplace(0, 0, 1, 0) = laplace(0, 0, -1, 0) = laplace(0, 0, 0, 1) = laplace(0, 0, 0, -1) = -1;
  Vector solution(nodes.size());
  try
  {
    solve(*make_operator(laplace, nodes), solution, random_vector(nodes), 1e-12, 3);
    FAIL();
  }
  catch (const NumericalError &error)
  {
    EXPECT_NE(std::string(error.what()).find("stop after 3 iterations"), std::string::npos);
  }
}

TEST(Stencil, knows_whether_it_is_even_and_symmetric)
{
  EXPECT_TRUE(random_stencil(2, 2, true).is_even());
  EXPECT_FALSE(random_stencil(4, 2, false).is_even());
  EXPECT_EQ(random_stencil(4, 2, false).symmetry_defect(), 0);
  // even in each block, but from one block to another it is not what it is back
  Stencil one_way(2, 1);
  one_way(0, 0, 0, 0) = one_way(1, 1, 0, 0) = 4;
  EXPECT_TRUE(one_way.is_even());
  one_way(0, 1, 1, 0) = one_way(0, 1, -1, 0) = 1;
  EXPECT_FALSE(one_way.is_even());
  Stencil skew(1, 1);
  skew(0, 0, 1, 0) = 1;
  EXPECT_EQ(skew.symmetry_defect(), 1);
}

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 2);
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
