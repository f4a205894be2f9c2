#pragma once

#include "physics/coefficient.h"
#include "physics/kernel.h"

#include <functional>

namespace plumbline::physics
{
  /// Constants of an isotropic linear elastic solid [force/length^2]: σ = λ tr(ε) I + 2μ ε. In
  /// plane strain they are those of the solid; in plane stress λ of the plane is
  /// 2λμ/(λ + 2μ) = Eν/(1 - ν²).
  struct Lame
  {
    double lambda = 0, mu = 0;

    bool operator==(const Lame &other) const { return lambda == other.lambda && mu == other.mu; }
  };

  enum class PlaneState
  {
    strain, ///< and solids in space
    stress  ///< λ is that of the plane, Eν/(1 - ν²)
  };

  /// @param E  Young's modulus > 0 [force/length^2]
  /// @throws InputError  E <= 0, nu <= -1, nu >= 1/2
  Lame lame_from_young(double E, double nu, PlaneState state);

  /// Bulk and shear constants of the variational state-based model in 2D: k = λ + μ, l = 8μ.
  /// Bond-based if l = 4k.
  /// @throws InputError  k <= 0 or l <= 0
  Lame lame_from_bulk(double k, double l);

  /// The influence function of a radial profile ρ(|ξ|/δ): K = c ρ with ∫K|ξ|² = dim, so that the
  /// dilatation ∫Kξ·(u(x+ξ) - u(x)) dξ of a linear field is its divergence. ρ = 1/t gives K =
  /// 3/(πδ³|ξ|) in the plane and 3/(πδ⁴|ξ|) in space. Instantiated for dim = 2 and 3.
  template <int dim>
  Kernel<dim> influence_function(RadialProfile profile, double horizon);

  /// The bonds of a state-based solid: 2 (dim + 2) μ K ξ⊗ξ/|ξ|². Instantiated for dim = 2 and 3.
  template <int dim>
  Kernel<dim> deviatoric_kernel(const Kernel<dim> &influence, double mu);

  /// What a state-based solid adds to its bonds, the forces of the dilatation
  ///   θ(x) = ∫ K ξ·(u(x+ξ) - u(x)) dξ,
  ///   L u(x) = -∫ K ξ [f(x, x+ξ) θ(x) + f(x+ξ, x) θ(x+ξ)] dξ
  ///            - ∫ 2 (dim + 2) μ K ξ⊗ξ/|ξ|² (u(x+ξ) - u(x)) dξ
  /// where f = λ - μ is taken at the dilatation's own point (variational model), or is the
  /// difference of the harmonic means of both ends (linear peridynamic solid). Zero where λ = μ:
  /// then only the bonds remain.
  /// Sources: Fan et al. 2022, eq. (2.5); Silling et al. 2007, doi:10.1007/s10659-007-9125-1.
  template <int dim>
  struct Dilatation
  {
    Kernel<dim> influence; ///< K, scalar, ∫K|ξ|² = dim
    std::function<Lame(const Point<dim> &)> material;
    bool is_two_point = false;   ///< harmonic means: heterogeneous operators are not symmetric
    bool is_homogeneous = false; ///< material is the same everywhere

    /// f for the dilatation of `own` in the force between both points.
    double factor(const Lame &own, const Lame &other) const
    {
      if (is_homogeneous || !is_two_point)
        return own.lambda - own.mu;
      return mean(Mean::harmonic, own.lambda, other.lambda) -
             mean(Mean::harmonic, own.mu, other.mu);
    }

    /// The operator with its bonds is symmetric.
    bool is_symmetric() const { return is_homogeneous || !is_two_point; }
  };
} // namespace plumbline::physics
