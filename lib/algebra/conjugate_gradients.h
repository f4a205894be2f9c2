#pragma once

#include "algebra/solve.h"
#include "base/error.h"

#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>

#include <cmath>
#include <sstream>

namespace plumbline::algebra
{
  /// Products of values must be numbers of double precision.
  inline void check_range(double norm)
  {
    constexpr double least = 1e-140, most = 1e140;
    if (norm > least && norm < most)
      return;
    std::ostringstream message;
    message << "the right-hand side has the norm " << norm << ", whose square is beyond double "
            << "precision; take a unit in which the data (Problem) are between 1e-100 and 1e100";
    throw NumericalError(message.str());
  }

  /// As `solve`, for the vectors of one rank or of many.
  template <class Matrix, class Preconditioner, class VectorType>
  SolveResult solve_with(const Matrix &matrix, const Preconditioner &preconditioner,
                         VectorType &solution, const VectorType &right_hand_side, double tolerance,
                         unsigned int max_iterations)
  {
    const double scale = right_hand_side.l2_norm();
    if (!std::isfinite(scale))
      throw NumericalError("the right-hand side holds a value that is not a finite number");
    if (scale == 0)
    {
      solution = 0.;
      return {0, 0};
    }
    check_range(scale);
    dealii::SolverControl control(max_iterations, tolerance * scale, false, false);
    dealii::SolverCG<VectorType> solver(control);
    try
    {
      solver.solve(matrix, solution, right_hand_side, preconditioner);
    }
    catch (const dealii::ExceptionBase &)
    {
      std::ostringstream message;
      message << "conjugate gradients stop after " << control.last_step()
              << " iterations at the relative residual " << control.last_value() / scale
              << ", wanted " << tolerance
              << "; the operator may not be positive definite, or raise Solver/max iterations";
      throw NumericalError(message.str());
    }
    if (!std::isfinite(solution.l2_norm()))
      throw NumericalError("conjugate gradients give a value that is not a finite number");
    return {control.last_step(), control.last_value() / scale};
  }
} // namespace plumbline::algebra
