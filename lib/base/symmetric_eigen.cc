#include "base/symmetric_eigen.h"

#include "base/error.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace plumbline::base
{
  namespace
  {
    using Solver = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>; // takes seconds to compile

    SymmetricEigen checked(const Solver &solver)
    {
      if (solver.info() != Eigen::Success || !solver.eigenvalues().allFinite())
        throw NumericalError("a symmetric matrix has no eigenvalues: an entry is not finite");
      return {solver.eigenvalues(), solver.eigenvectors()};
    }
  } // namespace

  SymmetricEigen symmetric_eigen(const Eigen::MatrixXd &matrix)
  {
    return checked(Solver(matrix));
  }

  SymmetricEigen tridiagonal_eigen(const Eigen::VectorXd &diagonal, const Eigen::VectorXd &beside)
  {
    // Eigen 3.4.0 scales whole matrices, but not these, and takes entries beside the diagonal for
    // zero by a bound that is not of their unit: at 1000 it finds no end
    double scale = diagonal.cwiseAbs().maxCoeff();
    if (beside.size() > 0)
      scale = std::max(scale, beside.cwiseAbs().maxCoeff());
    if (scale == 0)
      scale = 1;
    Solver solver;
    solver.computeFromTridiagonal(diagonal / scale, beside / scale);
    auto result = checked(solver);
    result.values *= scale;
    return result;
  }
} // namespace plumbline::base
