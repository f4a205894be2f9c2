#pragma once

#include "physics/kernel.h"
#include "physics/local_polynomials.h"

namespace plumbline::physics
{
  /// The radial functions that turn double integrals of a kernel in 2D into integrals over sides of
  /// cells. With q = |ξ|²/δ², ρ = 1 - q and C the kernel's radial factor, for scalar kernels:
  ///   Ψ = δ⁴ f(ρ), Δ²Ψ = C in the ball and beyond it, where C goes on by its formula, with
  ///   f = O(ρ⁴) at the circle, so that Ψ cut off there, on either side, is as smooth as C allows;
  ///   div (ξ δ⁴ g(ρ)) = -Ψ with g = O(ρ⁵).
  /// From Green's function of the operator D = d/dq (q d/dq), Δ = (4/δ²) D:
  ///   16 f = ∫_q^1 C(δ√s) [(s + q) ln(s/q) - 2 (s - q)] ds,   2 q g = ∫_q^1 f ds.
  /// Bond tensors C ξ⊗ξ/|ξ|² have these for half their trace, and beside it, for the rest
  /// H = ξ⊗ξ - ½|ξ|² 1 that changes with the direction,
  ///   Ψ = δ² H f, Δ²Ψ = C H/|ξ|²;   div (ξ δ² H g) = -Ψ:
  /// as Δ(H u) = (4/δ²) H q⁻² d/dq (q³ du/dq) for radial u,
  ///   96 q² f = ∫_q^1 C(δ√s) (s - q)³/s ds,   2 q² g = ∫_q^1 s f ds.
  /// f/ρ⁴ and g/ρ⁵ are tables of polynomials in ρ, made once for a kernel (some 30 ms). Accuracy:
  /// 1e-14 relative for ρ < .9; up to highest_rho 1e-13, of bond tensors 1e-12: a test. Thread
  /// safe.
  /// @tparam n_parts  1: scalar kernels, 2: bond tensors, half the trace first
  template <unsigned int n_parts>
  class PotentialTables
  {
  public:
    using Values = std::array<double, n_parts>;

    static constexpr double highest_rho = .96; ///< f has a logarithm or a pole at q = 0

    /// @param kernel      its profile without breaks
    /// @param lowest_rho  of arguments, < 0: 1 - (the largest |ξ| / δ)²
    PotentialTables(const Kernel<2> &kernel, double lowest_rho);

    double horizon() const { return horizon_; }
    double lowest_rho() const { return lowest_; }

    /// f, for lowest_rho <= ρ <= highest_rho. [1 / length^4 times the unit of the operator]
    Values f(double rho) const
    {
      const double square = rho * rho;
      return times(square * square, f_(rho));
    }
    Values g(double rho) const
    {
      const double square = rho * rho;
      return times(square * square * rho, g_(rho));
    }

    Values f_per_power(double rho) const { return f_(rho); } ///< f/ρ⁴
    Values g_per_power(double rho) const { return g_(rho); } ///< g/ρ⁵

  private:
    static Values times(double factor, Values values)
    {
      for (double &value : values)
        value *= factor;
      return values;
    }

    double horizon_, lowest_;
    LocalPolynomials<n_parts> f_, g_; ///< over ρ⁴ and ρ⁵
  };

  /// Those of a scalar kernel.
  class RadialPotential : public PotentialTables<1>
  {
  public:
    using PotentialTables::PotentialTables;

    double f(double rho) const { return PotentialTables::f(rho)[0]; }
    double g(double rho) const { return PotentialTables::g(rho)[0]; }
  };
} // namespace plumbline::physics
