#pragma once

#include <Eigen/Eigenvalues>

namespace plumbline::algebra
{
  /// A v = λ M v of Hermitian A and M, eigenvalues ascending, v*Mv = 1.
  /// @throws NumericalError  M is not positive definite, or an entry is not finite
  Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXcd>
  solve_pencil(const Eigen::MatrixXcd &stiffness, const Eigen::MatrixXcd &mass, bool has_vectors);
} // namespace plumbline::algebra
