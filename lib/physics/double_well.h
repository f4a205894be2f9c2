#pragma once

#include "physics/kernel.h"
#include "physics/well_potential.h"

namespace plumbline::physics
{
  /// Bonds with two wells, one at rest and one at infinity, in dim = 1, 2 or 3 dimensions:
  ///   ρ ü(x) = F(u)(x) + b,  F(u)(x) = 4 / (ε^(dim+1) ω_dim) ∫ ω(x) ω(y) J(r/ε) f'(r S²) S e dy
  /// over |y-x| = r < ε, with e = (y-x)/r, S = (u(y)-u(x))·e/r, ω_dim the volume of the unit ball
  /// and f(s) = c φ(βs), c = f(∞), by default c (1 - e^(-βs)). F = -∇PD, PD = 1 / (ε^(dim+1) ω_dim)
  /// ∬ ω ω J f(r S²) dy dx; small strains see the stiffness p = f'(0) = cβ.
  /// Source: Jha & Lipton 2018, doi:10.1137/17M1112236, (1), (6); PD with the factor |y-x| of the
  /// energy density, which is missing after (4).
  class DoubleWell
  {
  public:
    /// @param dim        1, 2 or 3
    /// @param influence  J(t), t = r/ε in [0, 1], bounded and not negative there
    /// @param c          f at infinity, > 0 [energy/length^(dim-1)]
    /// @param beta       β > 0 [1/length]
    /// @param horizon    ε > 0 [length]
    /// @param shape      φ
    /// @throws InputError  names the key that is out of range
    DoubleWell(int dim, RadialProfile influence, double c, double beta, double horizon,
               WellPotential shape = {});

    int dim() const { return dim_; }
    double c() const { return c_; }
    double beta() const { return beta_; }
    double horizon() const { return horizon_; }
    double stiffness() const { return c_ * beta_; } ///< p = f'(0)
    const RadialProfile &influence() const { return influence_; }
    const WellPotential &shape() const { return shape_; } ///< φ

    /// J(r/ε) for r <= ε; beyond, its formula, a negative one counting as 0: cells that a rule lets
    /// reach out of the ball take the kernel there.
    double influence(double r) const;

    /// M_n = ∫_0^1 t^n J(t) dt; infinite where the integral is.
    double moment(int n) const;

    double potential(double s) const;  ///< f(s), exact for small s as well
    double derivative(double s) const; ///< f'(s)
    double tangent(double s) const;    ///< f'(s) + 2s f''(s), the slope of the force over S

    /// The factor 4 / (ε^(dim+1) ω_dim) of F.
    double force_factor() const;

    /// The bond of length r softens beyond the strain S = r̄/√(βr), r̄² = ½ for the exponential.
    double softening_strain(double r) const;

    /// max |F₁'|, |F₁''|, |F₁'''| of F₁(r) = f(r²). Source: ibid., (70)-(72), where after (72) the
    /// derivative that vanishes at r̄ is F₁''.
    double c1() const, c2() const, c3() const;

    /// C̄ = C₂/ω_dim ∫ J/|ξ| over the unit ball; 6 C̄/ε² bounds the Lipschitz constant of F in L².
    /// Infinite in 1D unless J(0) = 0. Source: ibid., (35), (41).
    double c_bar() const;

    /// λ = μ of the elastic limit ε → 0 of the equation of motion: p M_2 / 2 in 2D, 2 p M_3 / 5 in
    /// 3D (printed: p M_dim / 5, of an energy without the factor ½); in 1D the modulus 2 p M_1.
    double modulus() const;

    /// Energy to open a crack, per length in 2D: (4/π) c M_2; area in 3D: (3/2) c M_3; in 1D c M_1.
    /// Printed is 3/2 for 2D as well.
    double toughness() const;

    /// Speeds of long waves: √(3 modulus/ρ), along the displacement, and √(modulus/ρ), across it;
    /// in 1D the first is √(modulus/ρ) and the second 0.
    struct WaveSpeeds
    {
      double longitudinal = 0, transverse = 0;
    };
    /// @throws InputError  density <= 0
    WaveSpeeds wave_speeds(double density = 1) const;

    /// F of small strains as a kernel: C(ξ) = 4p / (ε³π) J(r/ε)/r e⊗e, what rules make bonds for;
    /// in 1D the same of one component, 2p / ε² J(r/ε)/r.
    /// @pre dim == 1 or 2
    Kernel<2> linear_kernel() const;

  private:
    int dim_;
    RadialProfile influence_;
    double c_, beta_, horizon_;
    WellPotential shape_;
  };
} // namespace plumbline::physics
