#pragma once

#include "algebra/spectrum.h"
#include "analysis/motion.h"
#include "analysis/schemes.h"

#include <functional>

namespace plumbline::analysis
{
  /// Vectors of which each rank has a part.
  struct Parts
  {
    base::Communicator ranks = base::Communicator::alone();
    std::function<std::size_t(std::size_t)> number = {}; ///< of an own entry among all; empty: its
  };

  /// The largest eigenvalue of a symmetric operator from above: Ritz value plus residual of
  /// Lanczos' method with three vectors; without reorthogonalisation copies of eigenvalues appear,
  /// and none that is larger. The Ritz value alone is too small, and steps by it too long, which
  /// matters: at a step 1e-5 beyond the critical one motions grow by 1 % a step. Where both ends
  /// are asked for and there is memory for all vectors: algebra::spectrum.
  /// @param n          entries of this rank's vectors
  /// @param tolerance  of the residual relative to the eigenvalue, and so of the result
  /// @throws NumericalError  no convergence in 5000 steps
  /// Source: Parlett 1998, "The Symmetric Eigenvalue Problem", ch. 13,
  /// doi:10.1137/1.9781611971163.
  double largest_eigenvalue(const algebra::Action &symmetric, std::size_t n,
                            double tolerance = 1e-4, const Parts &parts = {});

  /// The longest step at which small motions about u stay bounded, z / √λ with λ the largest
  /// eigenvalue of -∂a/∂u and z the scheme's limit: 2/√λ for symplectic Euler and Verlet. About
  /// u = 0 it holds for all states of bonds that only soften. Damping is left out: it does not
  /// shorten the step of these schemes.
  /// @pre motion.tangent
  double critical_step(const Motion &motion, const Scheme &scheme, const Vector &u,
                       double tolerance = 1e-4);
} // namespace plumbline::analysis
