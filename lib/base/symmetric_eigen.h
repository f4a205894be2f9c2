#pragma once

#include <Eigen/Core>

namespace plumbline::base
{
  /// A symmetric matrix in its eigenvectors.
  struct SymmetricEigen
  {
    Eigen::VectorXd values;  ///< ascending
    Eigen::MatrixXd vectors; ///< columns of norm 1, in the same order
  };

  /// By Householder's tridiagonal form and QR steps, to rounding of the largest eigenvalue.
  /// @param matrix  shape (n, n), of which the lower triangle is read
  /// @throws NumericalError  an entry is not finite
  SymmetricEigen symmetric_eigen(const Eigen::MatrixXd &matrix);

  /// The same of a tridiagonal matrix.
  /// @param beside  the entries beside the diagonal, one fewer
  SymmetricEigen tridiagonal_eigen(const Eigen::VectorXd &diagonal, const Eigen::VectorXd &beside);
} // namespace plumbline::base
