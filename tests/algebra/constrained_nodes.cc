#include "algebra/constrained_nodes.h"

#include "algebra/operator.h"
#include "algebra/schwarz.h"
#include "algebra/solve.h"
#include "base/symmetric_eigen.h"

#include <deal.II/lac/vector.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace plumbline;
using namespace plumbline::algebra;
using geometry::Domain;
using geometry::Lattice;
using geometry::NodeSet;

namespace
{
  const Domain square{{{{0, 0}, {1, 1}}}, {}};

  Vector random_vector(std::size_t size, unsigned int seed)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Vector v(size);
    for (double &value : v)
      value = uniform(random);
    return v;
  }

  /// Bonds of a ball, w(k) = r^power.
  Stencil ball_stencil(int reach, double power)
  {
    Stencil stencil(1, reach);
    for (int k2 = -reach; k2 <= reach; ++k2)
      for (int k1 = -reach; k1 <= reach; ++k1)
        if (const double r = std::hypot(k1, k2); r > 0 && r <= reach)
        {
          stencil(0, 0, k1, k2) = -std::pow(r, power);
          stencil(0, 0, 0, 0) += std::pow(r, power);
        }
    return stencil;
  }

  NodeSet nodes_of(std::array<int, 2> n, unsigned int n_components = 1)
  {
    return {{{.5, false, 0}}, n_components, n, std::vector<char>(n[0] * n[1], 1)};
  }
} // namespace

TEST(SineRow, has_a_length_that_is_transformed_fast_and_the_row_in_its_middle)
{
  for (const int reach : {2, 3, 8, 20})
    for (int n = 200; n < 1100; ++n)
    {
      const int n_constrained = nodes_to_hold(reach, 1);
      const SineRow row = fast_sine_row(n, reach, n_constrained);
      ASSERT_EQ(row.n, row.n_before + n + row.n_after) << n;
      EXPECT_LE(std::abs(row.n_after - row.n_before), 1) << n;
      EXPECT_GE(row.n_before, row.n_constrained) << n;
      EXPECT_EQ(row.n_constrained, n_constrained) << n;
      EXPECT_LT(length_penalty(row.n), 2.5) << n; // no large prime
      EXPECT_LE(row.n_after, 20) << n;
      if (n_constrained ==
          0) // a zero 4.8 steps beyond the outermost node acts as the constraint does
      {
        EXPECT_GT(.5 * (row.n_before + row.n_after + 1), 2.5) << n;
        EXPECT_LT(.5 * (row.n_before + row.n_after + 1), 8.5) << n;
      }
    }
  EXPECT_EQ(length_penalty(1024), 1);
  EXPECT_EQ(length_penalty(13 * 75), 1);
  EXPECT_GT(length_penalty(13 * 77), 1.2); // 11
  EXPECT_GT(length_penalty(1031), 5);
  EXPECT_GT(length_penalty(2 * 257), 3);
}

TEST(SineRow, holds_nodes_where_that_pays)
{
  EXPECT_EQ(nodes_to_hold(2, 1), 2);
  EXPECT_EQ(nodes_to_hold(3, 1), 3);
  EXPECT_EQ(nodes_to_hold(13, 1), most_constrained);
  EXPECT_EQ(nodes_to_hold(14, 1), 0); // the zeros alone do
  EXPECT_EQ(nodes_to_hold(3, 2), 1);  // coupled components limit the iterations
}

TEST(ConstrainedNodes, of_an_operator_along_one_axis_invert_it)
{
  for (const auto &[reach, n_components] :
       {std::pair(2, 1U), {2, 2U}, {3, 1U}, {4, 1U}, {5, 1U}, {8, 1U}})
    for (const bool across : {false, true})
    {
      const std::array<int, 2> n = across ? std::array{3, 22} : std::array{22, 3};
      const SineRow row = fast_sine_row(22, reach, nodes_to_hold(reach, n_components));
      ASSERT_EQ(row.n, 22 + 2 * row.n_constrained); // no node around is free
      Stencil stencil(n_components, reach);
      for (unsigned int c = 0; c < n_components; ++c)
        for (int k = -reach; k <= reach; ++k)
          if (k != 0)
          {
            const double weight = std::pow(std::abs(k), -1. - 2 * c);
            (across ? stencil(c, c, 0, k) : stencil(c, c, k, 0)) = -weight;
            stencil(c, c, 0, 0) += weight;
          }
      const NodeSet nodes = nodes_of(n, n_components);
      const Vector u = random_vector(nodes.size(), 5);
      Vector f(u.size()), inverse(u.size());
      make_operator(stencil, nodes)->vmult(f, u);
      make_sine_solver(stencil, nodes, {{0, 0}, n}, {}, Zeros::fast)->add_inverse(inverse, f);
      inverse -= u;
      EXPECT_LT(inverse.linfty_norm(), 1e-12) << reach << ' ' << n_components;
    }
}

TEST(ConstrainedNodes, leave_a_symmetric_positive_definite_preconditioner)
{
  for (const std::array<int, 2> n : {std::array{1, 1}, {1, 9}, {9, 7}, {17, 3}})
    for (const int reach : {2, 3, 8})
      for (const unsigned int n_components : {1U, 2U})
      {
        const NodeSet nodes = nodes_of(n, n_components);
        Stencil stencil(n_components, reach); // the second component is twice as stiff along x
        const Stencil one = ball_stencil(reach, -1);
        for (unsigned int c = 0; c < n_components; ++c)
          for (int k2 = -reach; k2 <= reach; ++k2)
            for (int k1 = -reach; k1 <= reach; ++k1)
              if (k1 != 0 || k2 != 0)
              {
                stencil(c, c, k1, k2) = one(0, 0, k1, k2) * (c == 1 && k2 == 0 ? 2 : 1);
                stencil(c, c, 0, 0) -= stencil(c, c, k1, k2);
              }
        const auto solver = make_sine_solver(stencil, nodes, {{0, 0}, n}, {}, Zeros::fast);
        const auto size = static_cast<Eigen::Index>(nodes.size());
        Eigen::MatrixXd matrix(size, size);
        for (Eigen::Index i = 0; i < size; ++i)
        {
          Vector unit(nodes.size()), column(nodes.size());
          unit[i] = 1;
          solver->add_inverse(column, unit);
          matrix.col(i) = Eigen::Map<const Eigen::VectorXd>(column.begin(), size);
        }
        EXPECT_LT((matrix - matrix.transpose()).norm(), 1e-14 * matrix.norm());
        EXPECT_GT(base::symmetric_eigen(matrix).values[0], 0);
      }
}

TEST(ConstrainedNodes, are_not_there_where_a_stencil_of_reach_1_is_inverted_as_it_stands)
{
  const std::array<int, 2> n = {30, 16}; // 31 and 17 are primes
  const NodeSet nodes = nodes_of(n);
  const Stencil stencil = ball_stencil(1, 0);
  const Vector u = random_vector(nodes.size(), 5);
  Vector f(u.size()), inverse(u.size());
  make_operator(stencil, nodes)->vmult(f, u);
  make_sine_solver(stencil, nodes, {{0, 0}, n}, {}, Zeros::fast)->add_inverse(inverse, f);
  inverse -= u;
  EXPECT_LT(inverse.linfty_norm(), 1e-13);
}

TEST(ConstrainedNodes, leave_few_iterations_whatever_the_number_of_nodes)
{
  for (const auto &[reach, power, most] :
       {std::tuple{2, 0., 4u}, {3, -1., 4u}, {5, 0., 5u}, {8, 0., 6u}, {10, 0., 6u}, {13, 0., 7u}})
    for (const int n : {37, 64, 100, 101, 126, 127, 128, 129, 130, 256, 257})
    {
      const Stencil stencil = ball_stencil(reach, power);
      const Lattice lattice(square, 1. / n);
      const NodeSet nodes = nodes_of({n, n});
      const auto matrix = make_operator(stencil, nodes);
      const SchwarzPreconditioner preconditioner(stencil, nodes, maximal_rectangles(lattice));
      const Vector f = random_vector(nodes.size(), 3);
      Vector u(nodes.size()), residual(nodes.size());
      const SolveResult found = solve(*matrix, preconditioner, u, f, 1e-12, 500);
      EXPECT_LE(found.n_iterations, most) << n << ' ' << reach;
      matrix->vmult(residual, u);
      residual -= f;
      EXPECT_LT(residual.l2_norm(), 1e-11 * f.l2_norm()) << n;
    }
}
