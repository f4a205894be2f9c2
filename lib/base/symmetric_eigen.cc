#include "base/symmetric_eigen.h"

#include "base/error.h"

#include <Eigen/Eigenvalues>

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
    Solver solver;
    solver.computeFromTridiagonal(diagonal, beside);
    return checked(solver);
  }
} // namespace plumbline::base
