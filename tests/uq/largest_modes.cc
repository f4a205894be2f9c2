// The largest eigenvalues of matrices that are known by products alone.
#include "uq/largest_modes.h"
#include "base/error.h"
#include "uq/generator.h"

#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace plumbline;
using namespace plumbline::uq;

namespace
{
  using Eigen::MatrixXd;

  BlockProduct by(const MatrixXd &matrix)
  {
    return [&matrix](const double *x, double *y, unsigned int n)
    {
      Eigen::Map<MatrixXd>(y, matrix.rows(), n) =
          matrix * Eigen::Map<const MatrixXd>(x, matrix.rows(), n);
    };
  }

  /// Of given eigenvalues, with eigenvectors of chance.
  MatrixXd matrix_of(const std::vector<double> &eigenvalues)
  {
    const auto n = static_cast<Eigen::Index>(eigenvalues.size());
    Generator numbers(8);
    MatrixXd entries(n, n);
    for (double &entry : entries.reshaped())
      entry = numbers.normal();
    const MatrixXd q = Eigen::HouseholderQR<MatrixXd>(entries).householderQ();
    const auto values = Eigen::Map<const Eigen::VectorXd>(eigenvalues.data(), n);
    return q * values.asDiagonal() * q.transpose();
  }

  ModeSearch search_for(unsigned int n_modes, unsigned int block = 4)
  {
    ModeSearch search;
    search.n_modes = n_modes;
    search.block = block;
    return search;
  }

  void expect_modes(const MatrixXd &matrix, const std::vector<double> &eigenvalues,
                    const ModeSearch &search)
  {
    const LargestModes modes = largest_modes(eigenvalues.size(), by(matrix), search);
    EXPECT_TRUE(modes.is_settled);
    ASSERT_EQ(modes.eigenvalue.size(), search.n_modes);
    MatrixXd vectors(matrix.rows(), search.n_modes);
    for (unsigned int k = 0; k < search.n_modes; ++k)
    {
      EXPECT_NEAR(modes.eigenvalue[k], eigenvalues[k], 2e-13 * eigenvalues[0]) << k;
      vectors.col(k) = Eigen::Map<const Eigen::VectorXd>(modes.vector[k].data(), matrix.rows());
      const double residual =
          (matrix * vectors.col(k) - modes.eigenvalue[k] * vectors.col(k)).norm();
      EXPECT_LT(residual, 2e-12 * eigenvalues[0]) << k;
      EXPECT_LT(residual - modes.residual[k], 1e-13 * eigenvalues[0]) << k;
      const bool is_alone = (k == 0 || eigenvalues[k - 1] > eigenvalues[k]) &&
                            (k + 1 == search.n_modes || eigenvalues[k + 1] < eigenvalues[k]);
      if (is_alone)
      {
        EXPECT_LT(modes.residual[k] - residual, 1e-13 * eigenvalues[0]) << k;
      }
      EXPECT_LT(modes.residual[k], 5e-12 * eigenvalues[0]) << k;
    }
    const MatrixXd identity = MatrixXd::Identity(search.n_modes, search.n_modes);
    EXPECT_LT((vectors.transpose() * vectors - identity).cwiseAbs().maxCoeff(), 1e-13);
  }

  std::vector<double> powers(unsigned int n, double exponent)
  {
    std::vector<double> values(n);
    for (unsigned int k = 0; k < n; ++k)
      values[k] = std::pow(k + 1., exponent);
    return values;
  }
} // namespace

TEST(LargestModes, are_those_of_the_matrix_whether_it_decays_slowly_or_fast)
{
  for (const double exponent : {-.5, -2., -12.}) // the last to below rounding
  {
    const std::vector<double> eigenvalues = powers(400, exponent);
    const MatrixXd matrix = matrix_of(eigenvalues);
    for (const unsigned int n_modes : {1u, 12u, 40u})
      expect_modes(matrix, eigenvalues, search_for(n_modes));
  }
}

TEST(LargestModes, of_few_rows_are_all_there_are)
{
  const std::vector<double> eigenvalues = powers(20, -1);
  const MatrixXd matrix = matrix_of(eigenvalues);
  for (const unsigned int n_modes : {1u, 7u, 20u})
    expect_modes(matrix, eigenvalues, search_for(n_modes));
}

TEST(LargestModes, come_in_pairs_where_the_matrix_has_them)
{
  std::vector<double> eigenvalues = powers(300, -1);
  for (std::size_t k = 1; k < eigenvalues.size(); k += 2) // up to 4 equal ones
    eigenvalues[k] = eigenvalues[k - 1];
  eigenvalues[4] = eigenvalues[5] = eigenvalues[2];
  const MatrixXd matrix = matrix_of(eigenvalues);
  for (const unsigned int n_modes : {3u, 10u, 15u})
    expect_modes(matrix, eigenvalues, search_for(n_modes));
}

TEST(LargestModes, of_a_matrix_of_low_rank_go_on_with_zeros)
{
  std::vector<double> eigenvalues(300);
  eigenvalues[0] = 3, eigenvalues[1] = eigenvalues[2] = 2;
  const MatrixXd matrix = matrix_of(eigenvalues), nothing = MatrixXd::Zero(300, 300);
  expect_modes(matrix, eigenvalues, search_for(12));
  const LargestModes modes = largest_modes(300, by(nothing), search_for(6));
  EXPECT_TRUE(modes.is_settled);
  EXPECT_EQ(modes.eigenvalue, std::vector<double>(6));
}

TEST(LargestModes, of_few_products_know_how_far_off_they_are)
{
  const std::vector<double> eigenvalues = powers(400, -.3);
  const MatrixXd matrix = matrix_of(eigenvalues);
  double last = 0;
  for (const unsigned int n_products : {1u, 2u, 4u})
  {
    ModeSearch search = search_for(10, 20);
    search.most_products = n_products;
    const LargestModes modes = largest_modes(400, by(matrix), search);
    EXPECT_EQ(modes.n_products, n_products);
    EXPECT_FALSE(modes.is_settled);
    double sum = 0;
    for (unsigned int k = 0; k < 10; ++k)
    {
      double nearest = 1;
      for (const double eigenvalue : eigenvalues)
        nearest = std::min(nearest, std::abs(modes.eigenvalue[k] - eigenvalue));
      EXPECT_LE(nearest, modes.residual[k]);
      EXPECT_LE(modes.eigenvalue[k], eigenvalues[k] + 1e-14); // from below
      sum += modes.eigenvalue[k];
    }
    EXPECT_GT(sum, last);
    last = sum;
  }
}

TEST(LargestModes, have_the_same_bits_each_time_and_a_sign)
{
  const MatrixXd matrix = matrix_of(powers(300, -1));
  const LargestModes a = largest_modes(300, by(matrix), search_for(8));
  const LargestModes b = largest_modes(300, by(matrix), search_for(8));
  EXPECT_EQ(a.vector, b.vector);
  // another block gets there by another way
  const LargestModes c = largest_modes(300, by(matrix), search_for(8, 7));
  for (unsigned int k = 0; k < 8; ++k)
    for (std::size_t i = 0; i < 300; ++i)
      EXPECT_NEAR(a.vector[k][i], c.vector[k][i], 1e-10);
}

TEST(LargestModes, of_one_eigenspace_do_not_depend_on_rounding)
{
  std::vector<double> eigenvalues = powers(300, -1);
  eigenvalues[2] = eigenvalues[1];
  eigenvalues[6] = eigenvalues[5] = eigenvalues[4];
  const MatrixXd matrix = matrix_of(eigenvalues);
  const LargestModes a = largest_modes(300, by(matrix), search_for(9)),
                     b = largest_modes(300, by(matrix), search_for(9, 7)), // by another way
      few = largest_modes(300, by(matrix), search_for(3));
  for (unsigned int k = 0; k < 9; ++k)
    for (std::size_t i = 0; i < 300; ++i)
    {
      EXPECT_NEAR(a.vector[k][i], b.vector[k][i], 1e-9) << k << ' ' << i;
      if (k < 3)
      {
        EXPECT_NEAR(a.vector[k][i], few.vector[k][i], 1e-9) << k << ' ' << i;
      }
    }
  for (std::size_t row = 0; row < 300; ++row)
  {
    const auto together = [&](std::size_t i) { return std::hypot(a.vector[1][i], a.vector[2][i]); };
    double largest = 0;
    for (std::size_t i = 0; i < 300; ++i)
      largest = std::max(largest, together(i));
    if (together(row) < .75 * largest)
      continue;
    EXPECT_NEAR(a.vector[2][row], 0, 1e-12); // at the first such row
    break;
  }
}

TEST(LargestModes, let_no_number_through_that_is_none)
{
  MatrixXd matrix = matrix_of(powers(300, -1));
  matrix(3, 4) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(largest_modes(300, by(matrix), search_for(8)), NumericalError);
  EXPECT_THROW(largest_modes(300, by(matrix), search_for(300)), NumericalError);
}
