#include "algebra/operator.h"

#include "algebra/solve.h"
#include "algebra/sparse.h"
#include "base/error.h"

#include <deal.II/base/mpi.h>

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

  double relative_difference(const Stencil &stencil, const NodeSet &nodes, Road a, Road b)
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
        EXPECT_LT(relative_difference(stencil, nodes, Road::sparse, Road::fft), 1e-13);
        EXPECT_LT(relative_difference(stencil, nodes, Road::sparse, Road::direct), 1e-13);
      }
}

TEST(Operator, reach_beyond_the_domain_is_allowed)
{
  const NodeSet nodes = free_nodes(Lattice(square, .25), one_family, 1);
  const Stencil stencil = random_stencil(1, 6, true);
  EXPECT_LT(relative_difference(stencil, nodes, Road::sparse, Road::fft), 1e-13);
  EXPECT_LT(relative_difference(stencil, nodes, Road::sparse, Road::direct), 1e-13);
}

TEST(Operator, fft_and_sparse_roads_agree_for_several_families)
{
  for (const Domain &domain : {square, l_shape})
  {
    const NodeSet nodes = free_nodes(Lattice(domain, .125), two_families, 2);
    const Stencil stencil = random_stencil(8, 2, false);
    EXPECT_LT(relative_difference(stencil, nodes, Road::sparse, Road::fft), 1e-13);
  }
}

TEST(Operator, direct_road_is_refused_where_it_does_not_fit)
{
  const NodeSet nodes = free_nodes(Lattice(square, .25), two_families, 1);
  EXPECT_THROW(make_operator(random_stencil(4, 1, false), nodes, Road::direct), InputError);
  EXPECT_THROW(road_from_name("quantum"), InputError);
}

TEST(Operator, automatic_takes_the_direct_road_for_short_reach_and_transforms_for_long_reach)
{
  const NodeSet nodes = free_nodes(Lattice(square, 1. / 128), one_family, 1);
  EXPECT_EQ(make_operator(random_stencil(1, 2, true), nodes)->road(), "direct");
  EXPECT_EQ(make_operator(random_stencil(1, 30, true), nodes)->road(), "fft");
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

TEST(Solve, an_operator_that_is_not_positive_definite_is_an_error)
{
  const Lattice lattice(square, .125);
  const NodeSet nodes = free_nodes(lattice, one_family, 1);
  Stencil stencil = random_stencil(1, 2, true);
  stencil(0, 0, 0, 0) = -1;
  EXPECT_THROW(SchwarzPreconditioner(stencil, nodes, maximal_rectangles(lattice)), NumericalError);
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
