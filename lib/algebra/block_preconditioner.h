#pragma once

#include "algebra/multigrid.h"

namespace plumbline::algebra
{
  /// Of a system whose last unknowns are given by the first ones,
  ///   A x + B y = f,   C x + y = g,
  /// by the block triangular matrix [Â 0; C I] with one cycle of multigrid on A as Â⁻¹. What it
  /// leaves has the eigenvalues of (A - B C) Â⁻¹, and 1: it is as good as A is near to what
  /// eliminating y yields. That matrix, with its longer rows, is never made.
  /// Limits: of several ranks the last ones may hold y alone, and rest during the cycle.
  class BlockPreconditioner
  {
  public:
    using Vector = DistributedMatrix::Vector;

    /// @param matrix        of the whole system; a reference is kept
    /// @param n_first       size of x
    /// @param n_components  of x, a node
    /// @param nodes         places of the nodes of x, or none
    /// @note Collective. What Trilinos throws is thrown.
    BlockPreconditioner(const DistributedMatrix &matrix, std::size_t n_first,
                        unsigned int n_components, const std::vector<dealii::Point<2>> &nodes);

    /// @note Collective.
    void vmult(Vector &z, const Vector &r) const;

  private:
    const DistributedMatrix &matrix_;
    OwnedRanges first_; ///< ranks hold of x what they hold of the whole
    Multigrid multigrid_;
  };
} // namespace plumbline::algebra
