#include "algebra/solve.h"

#include "algebra/conjugate_gradients.h"

namespace plumbline::algebra
{
  SolveResult solve(const Operator &matrix, const SchwarzPreconditioner &preconditioner,
                    Vector &solution, const Vector &right_hand_side, double tolerance,
                    unsigned int max_iterations)
  {
    return solve_with(matrix, preconditioner, solution, right_hand_side, tolerance, max_iterations);
  }

  SolveResult solve(const Operator &matrix, Vector &solution, const Vector &right_hand_side,
                    double tolerance, unsigned int max_iterations)
  {
    return solve_with(matrix, dealii::PreconditionIdentity(), solution, right_hand_side, tolerance,
                      max_iterations);
  }
} // namespace plumbline::algebra
