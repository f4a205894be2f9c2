#pragma once

#include "algebra/stencil.h"
#include "physics/kernel.h"
#include "reference/shapes.h"

#include <array>
#include <vector>

namespace plumbline::reference
{
  /// The kernel that couples displacements through the product of their dilatations
  /// θ_u(x) = ∫ K ξ·(u(x+ξ) - u(x)) dξ in an infinite homogeneous body,
  ///   ∫ θ_u θ_v dx = -∬ v(x)·C(w) u(x+w) dw dx,   C(w) = ∫ K(|ξ|) ξ ⊗ K(|w-ξ|) (w-ξ) dξ.
  /// Kξ = -∇φ with φ of unit mass, a cone for K = 3/(πδ³|ξ|): so θ_u = φ ⋆ div u and C = ∇∇Ψ, where
  /// Ψ = φ ⋆ φ is radial, of unit mass, and zero beyond 2δ. C is bounded and continuous, so that it
  /// also serves discontinuous displacements; for the cone it behaves like |w| and w² log|w| at
  /// 0, (|w|-δ)² log||w|-δ| at δ and (2δ-|w|)^(3/2) at 2δ, and is smooth between. All entries
  /// [1/length^4].
  class DilatationKernel
  {
  public:
    /// C = along n⊗n + across (I - n⊗n), n = w/|w|.
    struct Value
    {
      double along = 0;  ///< Ψ''
      double across = 0; ///< Ψ'/|w|
    };

    /// Tabulates C, in 10 ms for the cone.
    /// @param influence  K, scalar, usually with ∫K|ξ|² = 2
    /// @throws InputError  an influence function with breaks
    explicit DilatationKernel(const physics::Kernel<2> &influence);

    double radius() const { return 2 * horizon_; }

    /// @param w  distance in [0, radius()] [length]
    /// Accuracy: 1e-13 of the largest entry; 1e-11 within 1e-5 δ of 2δ, where C vanishes.
    Value operator()(double w) const;

  private:
    static constexpr unsigned int n_terms = 18, n_levels = 16;
    using Series = std::array<Value, n_terms>; ///< Chebyshev coefficients

    double horizon_;
    std::vector<Series> series_; ///< (4, n_levels): halved towards 0, δ from both sides, 2δ
  };

  /// factor ∫θ_u θ_v as a stencil, the dilatation's part of the Galerkin matrix of a homogeneous
  /// state-based solid on a uniform lattice; with factor = λ - μ it is added to the stencil of the
  /// bonds, `deviatoric_kernel`. Two components, blocks as in geometry::NodeSet, every continuous
  /// and discontinuous space. Entries [unit of factor].
  /// Cell by cell in polar coordinates; as C is continuous, nothing hangs on which side of a circle
  /// a point lies.
  /// Accuracy: 1e-13 of the largest entry, 5e-13 for cubic elements; constants are in the kernel of
  /// the operator to round-off.
  algebra::Stencil dilatation_stencil(const physics::Kernel<2> &influence, double factor, double h,
                                      const AxisShapes &shapes);
} // namespace plumbline::reference
