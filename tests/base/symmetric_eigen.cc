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
    EXPECT_NEAR(whole.values[k], 2 - 2 * std::cos((k + 1) * M_PI / (n + 1)), 1e-14);
  EXPECT_LT((whole.values - bands.values).norm(), 1e-14);
  for (const auto &eigen : {whole, bands})
  {
    EXPECT_LT((chain * eigen.vectors - eigen.vectors * eigen.values.asDiagonal()).norm(), 1e-14);
    EXPECT_LT((eigen.vectors.transpose() * eigen.vectors - MatrixXd::Identity(n, n)).norm(), 1e-14);
  }
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
