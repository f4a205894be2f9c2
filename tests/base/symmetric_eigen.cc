#include "base/symmetric_eigen.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace plumbline;
using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(SymmetricEigen, a_chain_has_the_eigenvalues_of_its_waves)
{
  constexpr int n = 9;
  const VectorXd diagonal = VectorXd::Constant(n, 2), beside = VectorXd::Constant(n - 1, -1);
  MatrixXd chain = diagonal.asDiagonal();
  chain.diagonal(-1) = beside; // the upper triangle is not read
  const auto whole = base::symmetric_eigen(chain),
             bands = base::tridiagonal_eigen(diagonal, beside);
  chain.diagonal(1) = beside;
  for (int k = 0; k < n; ++k)
    EXPECT_NEAR(whole.values[k], 2 - 2 * std::cos((k + 1) * M_PI / (n + 1)), 1e-13);
  EXPECT_LT((whole.values - bands.values).norm(), 1e-13);
  for (const auto &eigen : {whole, bands})
  {
    EXPECT_LT((chain * eigen.vectors - eigen.vectors * eigen.values.asDiagonal()).norm(), 1e-13);
    EXPECT_LT((eigen.vectors.transpose() * eigen.vectors - MatrixXd::Identity(n, n)).norm(), 1e-13);
  }
}

TEST(SymmetricEigen, scale_with_their_matrix)
{
  constexpr int n = 300;
  VectorXd diagonal(n), beside(n - 1); // of a size, and without order, as Lanczos leaves them
  for (int i = 0; i < n; ++i)
    diagonal[i] = 1 + .3 * std::sin(1. + i * i);
  for (int i = 0; i + 1 < n; ++i)
    beside[i] = .3 + .1 * std::cos(2. + i * i);
  const auto one = base::tridiagonal_eigen(diagonal, beside);
  for (const double scale : {1e-200, 1e-6, 1e3, 1e12, 1e200})
  {
    const auto scaled = base::tridiagonal_eigen(scale * diagonal, scale * beside);
    EXPECT_LT((scaled.values / scale - one.values).cwiseAbs().maxCoeff(), 1e-13) << scale;
    for (int k = 0; k + 1 < n; ++k)
      EXPECT_LE(scaled.values[k], scaled.values[k + 1]);
  }
  EXPECT_EQ(base::tridiagonal_eigen(VectorXd::Zero(3), VectorXd::Zero(2)).values.norm(), 0);
}

TEST(SymmetricEigen, of_one_and_two_unknowns_are_their_closed_forms)
{
  const auto one = base::symmetric_eigen(MatrixXd::Constant(1, 1, -3));
  EXPECT_NEAR(one.values[0], -3, 1e-15);
  EXPECT_EQ(std::abs(one.vectors(0, 0)), 1);
  MatrixXd matrix(2, 2);
  matrix << 1, 2, 2, -2;
  const auto two = base::symmetric_eigen(matrix);
  EXPECT_NEAR(two.values[0], -3, 1e-15);
  EXPECT_NEAR(two.values[1], 2, 1e-15);
  EXPECT_LT((matrix * two.vectors.col(0) + 3 * two.vectors.col(0)).norm(), 1e-14);
}

TEST(SymmetricEigen, entries_that_are_no_numbers_are_an_error)
{
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
  {
    MatrixXd matrix = MatrixXd::Identity(4, 4);
    matrix(2, 1) = bad;
    EXPECT_THROW(base::symmetric_eigen(matrix), NumericalError);
    EXPECT_THROW(base::tridiagonal_eigen(VectorXd::Constant(3, bad), VectorXd::Ones(2)),
                 NumericalError);
    EXPECT_THROW(base::tridiagonal_eigen(VectorXd::Ones(3), VectorXd::Constant(2, bad)),
                 NumericalError);
  }
}
