#include "algebra/convolution.h"
#include "algebra/direct.h"
#include "algebra/linear_system.h"
#include "base/error.h"

#include <deal.II/lac/vector.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace plumbline;
using namespace plumbline::algebra;

namespace
{
  using Extents = std::array<int, 3>;

  std::vector<double> random_values(std::size_t n)
  {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<double> values(n);
    for (double &value : values)
      value = uniform(random);
    return values;
  }

  /// Even and symmetric, with other entries along each axis, diagonally dominant.
  Stencil even_stencil(unsigned int n_blocks, const Extents &reach)
  {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(.1, 1);
    Stencil stencil(n_blocks, reach);
    double total = 0;
    for (unsigned int s = 0; s < n_blocks; ++s)
      for (unsigned int t = 0; t <= s; ++t)
        for (int k3 = 0; k3 <= reach[2]; ++k3)
          for (int k2 = -reach[1]; k2 <= reach[1]; ++k2)
            for (int k1 = -reach[0]; k1 <= reach[0]; ++k1)
            {
              const double w = -uniform(random) * (s == t ? 1 : .3);
              stencil(s, t, k1, k2, k3) = stencil(s, t, -k1, -k2, -k3) = w;
              stencil(t, s, k1, k2, k3) = stencil(t, s, -k1, -k2, -k3) = w;
              total += std::abs(w);
            }
    for (unsigned int s = 0; s < n_blocks; ++s)
      stencil(s, s, 0, 0, 0) = 4 * total;
    return stencil;
  }

  /// The sum itself over input with a margin around the output.
  std::vector<double> summed(const Stencil &stencil, const Extents &n, const Extents &margin,
                             const std::vector<double> &input)
  {
    const auto &reach = stencil.reaches();
    const Extents extent = {n[0] + 2 * margin[0], n[1] + 2 * margin[1], n[2] + 2 * margin[2]};
    const auto at = [&](unsigned int s, int i, int j, int k)
    {
      i += margin[0], j += margin[1], k += margin[2];
      if (i < 0 || i >= extent[0] || j < 0 || j >= extent[1] || k < 0 || k >= extent[2])
        return 0.;
      return input[((s * extent[2] + k) * extent[1] + j) * extent[0] + i];
    };
    std::vector<double> result;
    for (unsigned int s = 0; s < stencil.n_blocks(); ++s)
      for (int k = 0; k < n[2]; ++k)
        for (int j = 0; j < n[1]; ++j)
          for (int i = 0; i < n[0]; ++i)
          {
            double sum = 0;
            for (unsigned int t = 0; t < stencil.n_blocks(); ++t)
              for (int k3 = -reach[2]; k3 <= reach[2]; ++k3)
                for (int k2 = -reach[1]; k2 <= reach[1]; ++k2)
                  for (int k1 = -reach[0]; k1 <= reach[0]; ++k1)
                    sum += stencil(s, t, k1, k2, k3) * at(t, i + k1, j + k2, k + k3);
            result.push_back(sum);
          }
    return result;
  }

  template <typename Values>
  double relative_difference(const Values &values, const std::vector<double> &expected)
  {
    double difference = 0, largest = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      difference = std::max(difference, std::abs(values[i] - expected[i]));
      largest = std::max(largest, std::abs(expected[i]));
    }
    return difference / largest;
  }
} // namespace

TEST(Box, operators_are_the_sum_over_neighbours)
{
  for (const unsigned int n_blocks : {1u, 2u, 3u})
    for (const Extents &reach : {Extents{1, 1, 1}, {3, 2, 4}, {2, 5, 1}})
    {
      const Extents n = {19, 6, 5};
      const Stencil stencil = even_stencil(n_blocks, reach);
      ASSERT_TRUE(stencil.is_even());
      const auto values = random_values(n_blocks * n[0] * n[1] * n[2]);
      const auto expected = summed(stencil, n, {}, values);
      const Vector input(values.begin(), values.end());
      Vector output(values.size());
      for (const auto backend : {OperatorBackend::direct, OperatorBackend::fft})
      {
        make_operator(stencil, geometry::BoxNodes{n}, backend)->vmult(output, input);
        EXPECT_LT(relative_difference(output, expected), 1e-13);
      }
    }
}

TEST(Box, action_of_given_values_around_it_is_the_sum_over_them)
{
  const Extents n = {6, 5, 4}, reach = {2, 2, 2};
  const Stencil stencil = even_stencil(3, reach);
  const auto values = random_values(3 * (n[0] + 4) * (n[1] + 4) * (n[2] + 4));
  EXPECT_LT(relative_difference(collar_action(stencil, geometry::BoxNodes{n}, values),
                                summed(stencil, n, reach, values)),
            1e-13);
}

TEST(Box, one_layer_without_reach_across_is_the_plane_to_the_last_bit)
{
  const std::array<int, 2> plane = {37, 21};
  const Extents slab = {plane[0], plane[1], 1};
  for (const unsigned int n_blocks : {1u, 2u})
  {
    const Stencil stencil = even_stencil(n_blocks, {3, 3, 0});
    const geometry::NodeSet nodes{
        {{.5, false, 0}}, n_blocks, plane, std::vector<char>(plane[0] * plane[1], 1)};
    const auto values = random_values(nodes.size());
    const Vector input(values.begin(), values.end());
    Vector in_plane(nodes.size()), as_slab(nodes.size());
    for (const auto backend : {OperatorBackend::direct, OperatorBackend::fft})
    {
      make_operator(stencil, nodes, backend)->vmult(in_plane, input);
      make_operator(stencil, geometry::BoxNodes{slab}, backend)->vmult(as_slab, input);
      EXPECT_TRUE(in_plane == as_slab);
    }
    in_plane = 0.;
    as_slab = 0.;
    make_sine_solver(stencil, nodes, {{0, 0}, plane})->add_inverse(in_plane, input);
    make_box_sine_solver(stencil, slab, {{}, slab})->add_inverse(as_slab, input);
    as_slab -= in_plane;
    EXPECT_LT(as_slab.linfty_norm(), 1e-14 * in_plane.linfty_norm());
  }
}

TEST(Box, sine_solver_inverts_an_operator_of_reach_1)
{
  const Extents n = {7, 6, 5};
  Stencil stencil(2, Extents{1, 1, 1});
  for (unsigned int s = 0; s < 2; ++s)
  {
    stencil(s, s, 0, 0, 0) = 13 + s;
    for (const int side : {-1, 1})
    {
      stencil(s, s, side, 0, 0) = -1;
      stencil(s, s, 0, side, 0) = -2;
      stencil(s, s, 0, 0, side) = -3;
    }
  }
  const auto values = random_values(2 * n[0] * n[1] * n[2]);
  const auto product = summed(stencil, n, {}, values);
  Vector inverse(values.size());
  make_box_sine_solver(stencil, n, {{}, n})
      ->add_inverse(inverse, Vector(product.begin(), product.end()));
  EXPECT_LT(relative_difference(inverse, values), 1e-14);

  stencil(1, 1, 0, 0, 0) = 1;
  EXPECT_THROW(make_box_sine_solver(stencil, n, {{}, n}), NumericalError);
}

TEST(Box, stencils_in_space_know_whether_they_are_even_and_symmetric)
{
  Stencil stencil = even_stencil(2, {2, 1, 3});
  EXPECT_EQ(stencil.symmetry_defect(), 0);
  const Stencil twice = add(stencil, Stencil(2, {1, 2, 0}));
  EXPECT_EQ(twice.reaches(), (Extents{2, 2, 3}));
  EXPECT_EQ(twice(0, 1, 2, -1, 3), stencil(0, 1, 2, -1, 3));
  stencil(0, 0, 1, 0, -2) *= 2;
  EXPECT_FALSE(stencil.is_even());
  EXPECT_GT(stencil.symmetry_defect(), 1e-4);
}

TEST(Box, nodes_that_are_not_free_are_zero_and_do_not_act)
{
  const Extents n = {9, 7, 6}, reach = {2, 2, 2};
  geometry::BoxNodes nodes{n, std::vector<char>(9 * 7 * 6, 1)};
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        nodes.is_free[i + n[0] * (j + n[1] * k)] = i < 4 || (j < 3 && k > 1) ? 1 : 0;
  for (const unsigned int n_blocks : {1u, 3u})
  {
    const auto masked = [&](std::vector<double> values)
    {
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] *= nodes.is_free[i % nodes.n_positions()];
      return values;
    };
    const Stencil stencil = even_stencil(n_blocks, reach);
    const auto values = masked(random_values(n_blocks * nodes.n_positions())),
               product = masked(summed(stencil, n, {}, values));
    const Vector input(values.begin(), values.end());
    Vector output(values.size());
    for (const auto backend : {OperatorBackend::direct, OperatorBackend::fft})
    {
      const auto matrix = make_operator(stencil, nodes, backend);
      matrix->vmult(output, input);
      EXPECT_LT(relative_difference(output, product), 1e-13);
      EXPECT_EQ(matrix->n_bonds(), stencil.n_entries() * nodes.n_free());
    }
    const auto around = random_values(n_blocks * (n[0] + 4) * (n[1] + 4) * (n[2] + 4));
    EXPECT_LT(relative_difference(collar_action(stencil, nodes, around),
                                  masked(summed(stencil, n, reach, around))),
              1e-13);

    Vector solution(values.size());
    const auto solved = StencilSystem(stencil, nodes, OperatorBackend::automatic)
                            .solve(solution, Vector(product.begin(), product.end()), {1e-14, 100});
    EXPECT_LT(relative_difference(solution, values), 1e-12);
    EXPECT_LT(solved.n_iterations, 30u);
  }
}

TEST(Box, sine_solver_inverts_an_operator_of_reach_1_on_a_part_of_the_positions)
{
  const Extents n = {9, 8, 6};
  const geometry::CubeRange part = {{2, 1, 1}, {7, 8, 4}};
  Stencil stencil(1, Extents{1, 1, 1});
  stencil(0, 0, 0, 0, 0) = 13;
  for (const int side : {-1, 1})
  {
    stencil(0, 0, side, 0, 0) = -1;
    stencil(0, 0, 0, side, 0) = -2;
    stencil(0, 0, 0, 0, side) = -3;
  }
  auto values = random_values(n[0] * n[1] * n[2]);
  const auto restrict_to_part = [&](std::vector<double> &all)
  {
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i)
          if (i < part.lower[0] || i >= part.upper[0] || j < part.lower[1] || j >= part.upper[1] ||
              k < part.lower[2] || k >= part.upper[2])
            all[i + n[0] * (j + n[1] * k)] = 0;
  };
  restrict_to_part(values);
  auto product = summed(stencil, n, {}, values);
  Vector inverse(values.size());
  // what is outside of the part is not seen
  make_box_sine_solver(stencil, n, part)
      ->add_inverse(inverse, Vector(product.begin(), product.end()));
  EXPECT_LT(relative_difference(inverse, values), 1e-14);
}
