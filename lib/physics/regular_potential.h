#pragma once

#include "physics/kernel.h"
#include "physics/local_polynomials.h"

namespace plumbline::physics
{
  /// The potential without a horizon of a scalar kernel that is a smooth function of ξ, like a
  /// Gaussian: it is smooth itself. With q = |ξ|²/δ²,
  ///   Ψ = δ⁴ f(q), Δ²Ψ = C for all ξ, f = q²/16 ∫_0^1 C(δ√(qτ)) k(τ) dτ,
  ///   k(τ) = (1 + τ) ln(1/τ) - 2 (1 - τ), and div (ξ δ⁴ g) = Ψ with 2 q g = ∫_0^q f ds.
  /// f/q² and g/q² are tables of polynomials; the integrals, whose weight has a logarithm, are made
  /// of four simple ones. Accuracy: 1e-14 of f at the largest q: a test. Thread safe.
  class RegularPotential
  {
  public:
    /// @param kernel    scalar, even, without breaks
    /// @param farthest  largest |ξ| / δ of arguments
    RegularPotential(const Kernel<2> &kernel, double farthest);

    /// Whether the kernel varies slowly enough for its tables.
    static bool can_have(const Kernel<2> &kernel, double farthest);

    /// 0 <= q <= farthest². [1 / length^4 times the unit of the operator]
    double f(double q) const { return q * q * tables_(1 - q)[0]; }
    double g(double q) const { return q * q * tables_(1 - q)[1]; }

  private:
    LocalPolynomials<2> tables_; ///< of 1 - q
  };
} // namespace plumbline::physics
