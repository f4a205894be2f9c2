#pragma once

#include "algebra/linear_system.h"

#include <array>
#include <memory>

namespace plumbline::algebra
{
  /// A stencil on a box of nodes whose components are strongly coupled, such as that of a nearly
  /// incompressible solid. Preconditioners of each component then see stiff shear where there is
  /// none, and their iterations grow as √(λ/μ) and with n. Here nothing is lost of the coupling:
  /// the box is part of a periodic one, whose operator C is inverted exactly, mode by mode, with
  /// all components. Forces λ on the layer around the box make the displacements there vanish,
  ///   u = C⁻¹ (f + λ) + c,   u = 0 on the layer,   Σ (f + λ) = 0,
  /// c constants, which C does not see. That is Xλ = -C⁻¹f on the layer, X = C⁻¹ restricted to it,
  /// by conjugate gradients on λ without a mean. The layer is the union of three slabs, one across
  /// each axis; on a slab alone X is block circulant, so that it is inverted exactly as well, mode
  /// by mode along the slab. The sum of these inverses preconditions. A step takes one transform of
  /// each component there and back, a preconditioner of each component twice as many.
  /// Measured, linear peridynamic solids in space of m = 3: 25 iterations at ν = .2, 40 at .495 and
  /// 60 at .4999, for n = 8 to 64 alike.
  /// Source: as constraints by multipliers and a coarse problem of constants, Farhat & Roux 1991,
  /// doi:10.1002/nme.1620320604; the sum of local inverses, Widlund & Dryja 1987.
  /// Limits: the box whole; even stencils of two or three components; one rank.
  class MultiplierSystem : public LinearSystem
  {
  public:
    /// @throws NumericalError  the stencil is not symmetric or not coercive
    /// @throws InputError      a backend that cannot do it, see `make_operator`
    MultiplierSystem(const Stencil &stencil, const std::array<int, 3> &n, OperatorBackend backend);
    ~MultiplierSystem() override;

    void vmult(Vector &y, const Vector &x) const override;

    /// Ends where the residual, computed anew, is small enough, or as small as rounding lets it be:
    /// ε ‖A‖ ‖x‖.
    LinearSolve solve(Vector &x, const Vector &b, const Stopping &stopping) const override;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
  };

  /// Stiffness along a wave over that across it, of long waves along an axis: (λ + 2μ) / μ. 1 for
  /// one component.
  double coupling(const Stencil &stencil);

  /// The solver for a stencil on nodes in space that promises the least time: multipliers where
  /// components are coupled strongly, else StencilSystem.
  std::unique_ptr<LinearSystem>
  make_box_system(const Stencil &stencil, const geometry::BoxNodes &nodes, OperatorBackend backend);
} // namespace plumbline::algebra
