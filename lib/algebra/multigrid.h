#pragma once

#include "algebra/distributed_matrix.h"

#include <deal.II/base/point.h>
#include <deal.II/lac/trilinos_precondition.h>

namespace plumbline::algebra
{
  /// One cycle of ML's smoothed aggregation, for elliptic systems, symmetric or not.
  class Multigrid
  {
  public:
    using Vector = DistributedMatrix::Vector;

    /// @param own           this rank's share of the rows, each with a diagonal entry
    /// @param n_components  unknowns a node, numbered node by node
    /// @param nodes         places of all nodes, or none: with dim components rotations are among
    ///                      the near-null modes then, besides the constants
    /// @note Collective. What Trilinos throws is thrown. Instantiated for dim = 2 and 3.
    template <int dim>
    Multigrid(const CsrView &own, const OwnedRanges &ranges, unsigned int n_components,
              const std::vector<dealii::Point<dim>> &nodes);

    /// y ≈ A⁻¹ x. @note Collective.
    void vmult(Vector &y, const Vector &x) const { cycle_.vmult(y, x); }

  private:
    dealii::TrilinosWrappers::SparseMatrix entries_; ///< a copy, which the cycle refers to
    dealii::TrilinosWrappers::PreconditionAMG cycle_;
  };
} // namespace plumbline::algebra
