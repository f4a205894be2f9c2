#pragma once

#include "algebra/linear_system.h"
#include "geometry/cube_families.h"

namespace plumbline::algebra
{
  /// Couplings of a stencil between free nodes of several families in space, by transforms.
  /// @throws InputError  another backend than automatic or fft
  std::unique_ptr<Operator> make_operator(const Stencil &stencil,
                                          const geometry::CubeFamilies &nodes,
                                          OperatorBackend backend = OperatorBackend::automatic);

  /// The action of given values outside the free nodes on the free nodes: Σ_k A(k) g(i + k).
  /// @param data  shape (n_blocks, n[2] + 2 reach, n[1] + 2 reach, n[0] + 2 reach), 0 at free ones
  Vector collar_action(const Stencil &stencil, const geometry::CubeFamilies &nodes,
                       const std::vector<double> &data);

  /// A stencil on several families of nodes in space, by conjugate gradients; the preconditioner is
  /// the sum of block sine solvers over boxes of cells that cover Ω.
  class FamilySystem : public LinearSystem
  {
  public:
    /// @throws NumericalError  the stencil is not symmetric or not positive definite
    /// @throws InputError      a backend that cannot do it
    FamilySystem(const Stencil &stencil, const geometry::CubeFamilies &nodes,
                 const std::vector<geometry::CubeRange> &boxes, OperatorBackend backend);

    void vmult(Vector &y, const Vector &x) const override { operator_->vmult(y, x); }
    LinearSolve solve(Vector &x, const Vector &b, const Stopping &stopping) const override;

  private:
    std::unique_ptr<Operator> operator_;
    SchwarzPreconditioner preconditioner_;
  };
} // namespace plumbline::algebra
