#include "algebra/block_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace plumbline::algebra;

namespace
{
  /// Rows of n nodes in a ring, each with its two nearest neighbours on either side; blocks -g⊗g,
  /// or any.
  CsrMatrix ring(unsigned int n, unsigned int n_components, bool has_directions)
  {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    CsrMatrix rows;
    rows.start = {0};
    for (unsigned int i = 0; i < n; ++i)
    {
      std::vector<unsigned int> nodes;
      for (const unsigned int step : {n - 2, n - 1, 0u, 1u, 2u})
        nodes.push_back((i + step) % n);
      std::sort(nodes.begin(), nodes.end());
      std::vector<std::vector<double>> g(nodes.size());
      for (auto &one : g)
        for (unsigned int c = 0; c < n_components; ++c)
          one.push_back(uniform(random));
      for (unsigned int c = 0; c < n_components; ++c)
      {
        for (std::size_t k = 0; k < nodes.size(); ++k)
          for (unsigned int d = 0; d < n_components; ++d)
          {
            rows.column.push_back(n_components * nodes[k] + d);
            rows.value.push_back(has_directions ? -g[k][c] * g[k][d] : uniform(random));
          }
        rows.start.push_back(rows.column.size());
      }
    }
    return rows;
  }

  double largest_difference(const CsrMatrix &rows, const BlockRows &blocks)
  {
    std::vector<double> x, y(rows.n_rows());
    for (std::size_t i = 0; i < rows.n_rows(); ++i)
      x.push_back(std::sin(1. + static_cast<double>(i)));
    const std::size_t half = blocks.n_nodes() / 2;
    blocks.vmult(x.data(), y.data(), half, blocks.n_nodes());
    blocks.vmult(x.data(), y.data(), 0, half);
    double largest = 0;
    for (std::size_t i = 0; i < rows.n_rows(); ++i)
    {
      double sum = 0;
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
        sum += rows.value[k] * x[rows.column[k]];
      largest = std::max(largest, std::abs(sum - y[i]));
    }
    return largest;
  }
} // namespace

TEST(BlockRows, have_the_products_of_the_matrix)
{
  for (const unsigned int n_components : {2u, 3u})
    for (const bool has_directions : {false, true})
    {
      const CsrMatrix rows = ring(11, n_components, has_directions);
      const auto blocks = BlockRows::make(rows, n_components);
      ASSERT_TRUE(blocks);
      EXPECT_EQ(blocks->are_directed(), has_directions);
      EXPECT_EQ(blocks->n_bonds(), 44u);
      EXPECT_LT(largest_difference(rows, *blocks), 5e-15) << n_components;
    }
}

TEST(BlockRows, keep_whole_blocks_of_bonds_with_negative_weights)
{
  CsrMatrix rows = ring(7, 3, true);
  for (double &value : rows.value)
    value = -value; // +g⊗g: bonds of negative weight
  const auto blocks = BlockRows::make(rows, 3);
  ASSERT_TRUE(blocks);
  EXPECT_FALSE(blocks->are_directed());
  EXPECT_LT(largest_difference(rows, *blocks), 5e-15);
}

TEST(BlockRows, are_not_made_of_other_matrices)
{
  const CsrMatrix rows = ring(6, 2, true);
  EXPECT_FALSE(BlockRows::make(rows, 1));
  EXPECT_FALSE(BlockRows::make(rows, 3)); // two nodes' components in a block
  CsrMatrix no_own = rows;                // a row without its own node
  no_own.column[0] = no_own.column[10] = 6;
  no_own.column[1] = no_own.column[11] = 7;
  EXPECT_FALSE(BlockRows::make(no_own, 2));
  CsrMatrix uneven = rows;
  std::swap(uneven.column[2], uneven.column[3]);
  EXPECT_FALSE(BlockRows::make(uneven, 2));
}
