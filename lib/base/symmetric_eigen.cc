#include "base/symmetric_eigen.h"

#include "base/error.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace plumbline::base
{
  // Eigen 3.4.0 takes entries beside the diagonal for zero by a bound that is not of their unit:
  // where eigenvalues are some 10 times above the largest entry, to which it scales, or matrices
  // are tridiagonal, which it does not scale, it may end before they are found, with any order. Up
  // to eigenvalues of 1 the bound is sound.
  SymmetricEigen symmetric_eigen(const Eigen::MatrixXd &matrix)
  {
    const double largest = matrix.cwiseAbs().maxCoeff(), scale = largest > 0 ? largest : 1;
    const Eigen::Tridiagonalization<Eigen::MatrixXd> form(matrix / scale);
    SymmetricEigen result = tridiagonal_eigen(form.diagonal(), form.subDiagonal());
    result.values *= scale;
    result.vectors = form.matrixQ() * result.vectors;
    return result;
  }

  SymmetricEigen tridiagonal_eigen(const Eigen::VectorXd &diagonal, const Eigen::VectorXd &beside)
  {
    const double largest = std::max(diagonal.cwiseAbs().maxCoeff(),
                                    beside.size() > 0 ? beside.cwiseAbs().maxCoeff() : 0),
                 scale = largest > 0 ? 3 * largest : 1;    // no eigenvalue is above (Gershgorin)
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver; // takes seconds to compile: here alone
    solver.computeFromTridiagonal(diagonal / scale, beside / scale);
    if (solver.info() != Eigen::Success || !solver.eigenvalues().allFinite())
      throw NumericalError("a symmetric matrix has no eigenvalues: an entry is not finite");
    return {scale * solver.eigenvalues(), solver.eigenvectors()};
  }
} // namespace plumbline::base
