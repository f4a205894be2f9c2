#pragma once

#include "algebra/operator.h"
#include "algebra/schwarz.h"

namespace plumbline::algebra
{
  struct SolveResult
  {
    unsigned int n_iterations = 0;
    double relative_residual = 0;
  };

  /// Conjugate gradients from the given start value.
  /// @param tolerance  of the residual's Euclidean norm, relative to the right-hand side's
  /// @throws NumericalError  no convergence within max_iterations, an operator that is not positive
  ///                         definite, or a value that is not a number
  SolveResult solve(const Operator &matrix, const SchwarzPreconditioner &preconditioner,
                    Vector &solution, const Vector &right_hand_side, double tolerance,
                    unsigned int max_iterations);

  /// The same without a preconditioner.
  SolveResult solve(const Operator &matrix, Vector &solution, const Vector &right_hand_side,
                    double tolerance, unsigned int max_iterations);
} // namespace plumbline::algebra
