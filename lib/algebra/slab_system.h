#pragma once

#include "algebra/linear_system.h"
#include "base/slabs.h"

#include <array>
#include <memory>

namespace plumbline::algebra
{
  /// A stencil on the free nodes of a box of which each rank has a slab of planes: the counterpart
  /// of StencilSystem for one problem on many ranks. Each rank applies the stencil to its slab by
  /// the operators of one rank, with a halo of planes within reach from the ranks beside it;
  /// the preconditioner is a distributed sine transform. If some nodes are not free, there is one
  /// transform for each maximal box of free nodes, distributed over all ranks, and their results
  /// are added (additive Schwarz, as on one rank). Memory and work of a rank fall as 1 / (number of
  /// ranks), except for the halo and the mask of free nodes, as long as there are planes for all
  /// ranks. Vectors are this rank's, shape (n_blocks, n_owned, n[1], n[0]), and vanish where nodes
  /// are not free.
  class SlabSystem : public LinearSystem
  {
  public:
    /// @param slabs  of the nodes' n[2] planes
    /// @pre no maximal box of free nodes is a single line of nodes along z
    /// @note Collective, as all functions.
    /// @throws NumericalError  the stencil is not symmetric or not coercive
    /// @throws InputError      a backend that cannot do it, see `make_operator`
    SlabSystem(const Stencil &stencil, const geometry::BoxNodes &nodes, const base::Slabs &slabs,
               OperatorBackend backend);
    ~SlabSystem() override;

    void vmult(Vector &y, const Vector &x) const override;
    LinearSolve solve(Vector &x, const Vector &b, const Stopping &stopping) const override;

    /// The preconditioner: y is an approximation of the solution for x.
    void precondition(Vector &y, const Vector &x) const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
  };
} // namespace plumbline::algebra
