#pragma once

#include "algebra/linear_system.h"

#include <array>
#include <memory>

namespace plumbline::algebra
{
  /// A stencil on a box of nodes whose components are strongly coupled, such as that of a nearly
  /// incompressible solid. A preconditioner for each component alone ignores that deformations
  /// without a change of volume are soft: iterations grow as √(λ/μ), and with n. Here all
  /// components are inverted together. The box is embedded in a periodic one, whose operator C is
  /// inverted exactly, mode by mode. Forces λ on the layer of constrained nodes around the box make
  /// the displacements there vanish,
  ///   u = C⁻¹ (f + λ) + c,   u = 0 on the layer,   Σ (f + λ) = 0,
  /// with constants c, the kernel of C. Up to c, Xλ = -C⁻¹f on the layer, X = C⁻¹ restricted to it,
  /// solved by conjugate gradients for λ with given sum. The layer is the union of three slabs, one
  /// across each axis; on a slab alone X is block circulant, so that it is inverted exactly, mode
  /// by mode along the slab. The sum of these is the preconditioner: eigenvalues are at most
  /// 3, the number of slabs that a node is in. A step takes a Fourier transform per component
  /// and its inverse; one of StencilSystem takes sine transforms as well. Measured, linear
  /// peridynamic solids in space, m = 3, n = 16, 32, 64, to 1e-12 of the residual: 26 to 29
  /// iterations at ν = .2, 43 to 48 at .495 and 58 to 86 at .4999; StencilSystem 19 to 21, 103 to
  /// 144 and more than 1000. The number is nearly independent of n but not bounded in λ/μ: for
  /// n = 16 and 32 it is 119 to 148 at .49999, and 177 (Q1) to 432 (FA) at .499999, where that of
  /// FA grows as √(λ/μ). Memory at n = 64: 155 bytes per unknown (83). Source: constraints by
  /// multipliers and a coarse problem of constants, Farhat & Roux 1991, doi:10.1002/nme.1620320604;
  /// the sum of inverses on overlapping parts is additive Schwarz, Smith, Bjørstad & Gropp 1996,
  /// Domain Decomposition. Limits: one whole box; even stencils of at most three components that
  /// couple two components by entries that are odd along the axes of both, as isotropic solids on
  /// lattices do; one rank.
  class MultiplierSystem : public LinearSystem
  {
  public:
    /// @throws NumericalError  the stencil is not symmetric or not coercive
    /// @throws InputError      a backend that cannot do it, see `make_operator`
    MultiplierSystem(const Stencil &stencil, const std::array<int, 3> &n, OperatorBackend backend);
    ~MultiplierSystem() override;

    void vmult(Vector &y, const Vector &x) const override;

    /// Stops when the recomputed residual is below the tolerance, or below ε Λ ‖x‖, Λ the largest
    /// eigenvalue of the periodic operator: rounding of x alone causes as much. The relative
    /// residual that is returned then exceeds the tolerance.
    LinearSolve solve(Vector &x, const Vector &b, const Stopping &stopping) const override;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
  };

  /// Memory of a MultiplierSystem [bytes]: its matrices grow as n² reach².
  double multiplier_bytes(unsigned int n_blocks, const std::array<int, 3> &n,
                          const std::array<int, 3> &reaches);

  /// It is not chosen if it needs more memory than this [bytes].
  double most_multiplier_bytes(unsigned int n_blocks, const std::array<int, 3> &n);

  /// The memory for a stencil whose reach is known to lie in [least, most]: 0 if it is not chosen
  /// even with the least.
  double expected_multiplier_bytes(unsigned int n_blocks, const std::array<int, 3> &n, int least,
                                   int most);

  /// Whether a MultiplierSystem can handle the stencil, see its limits.
  bool has_mirror_images(const Stencil &stencil);

  /// Ratio of longitudinal to transverse stiffness of long waves along an axis: (λ + 2μ) / μ. 1 for
  /// one component.
  double coupling(const Stencil &stencil);

  /// A MultiplierSystem is chosen if the coupling is larger than this. Both solvers take the same
  /// time there for n <= 32; at n = 64 multipliers are faster from a coupling of 3 on.
  constexpr double strong_coupling = 10;

  /// The solver for a stencil on nodes in space, chosen by the coupling alone: multipliers if it is
  /// strong, within their limits; otherwise, or if the periodic operator is not positive definite,
  /// StencilSystem.
  std::unique_ptr<LinearSystem>
  make_box_system(const Stencil &stencil, const geometry::BoxNodes &nodes, OperatorBackend backend);
} // namespace plumbline::algebra
