#pragma once

#include "physics/radial_potential.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace plumbline::physics
{
  /// Radial potentials of a scalar kernel C in 2D as functions of u = |ξ|²: Δ²Ψ₂ = C, ΔΨ₃ = Ψ₂,
  /// ΔΨ₄ = Ψ₃.
  struct PotentialJet
  {
    double value = 0;                     ///< Ψ₂
    double first[3] = {}, second[3] = {}; ///< derivatives of Ψ₂, Ψ₃, Ψ₄
  };

  /// Those that vanish with their derivatives at the horizon, so that they may be cut off there.
  /// With q = u/δ², ρ = 1 - q: Ψ₂ = δ⁴ f(ρ), f = O(ρ⁴), as RadialPotential has it; from the same
  /// Green's function
  ///   f' = ρ³/(16 q²) ∫_0^1 C τ² R(ρτ/q) dτ, R(x) = (x - ln(1 + x))/x²,
  ///   f'' = ρ²/(16 q²) ∫_0^1 C τ dτ, C at δ√(q + ρτ);
  /// Ψ_k = δ^2k f_k, f_(k+1)' = g_k/2, 2 q g_k = ∫_0^ρ f_k.
  /// Tables of polynomials in ρ. Accuracy: 1e-14 relative to ρ = .9, a test. Thread safe.
  class CircleJets
  {
  public:
    /// @param kernel      scalar, its profile without breaks
    /// @param lowest_rho  of arguments, < 0: 1 - (the largest |ξ| / δ)²
    CircleJets(const Kernel<2> &kernel, double lowest_rho);

    double square() const { return square_; } ///< δ²

    /// @tparam n_orders  how many potentials, from Ψ₂ on
    template <unsigned int n_orders>
    PotentialJet at(double u) const
    {
      constexpr unsigned int n = n_orders < 3 ? 4 : n_functions; // whole vector registers
      const double rho = std::min(1 - u * inverse_, RadialPotential::highest_rho),
                   per_q = 1 / (1 - rho);
      const auto reduced = tables_.template first<n>(rho);
      const double two = rho * rho, four = two * two, f = four * reduced[0];
      PotentialJet jet{square_ * square_ * f,
                       {-square_ * two * rho * reduced[1], 0, 0},
                       {two * reduced[2], 0, 0}};
      if constexpr (n_orders > 1)
      {
        const double g = four * rho * reduced[3];
        jet.first[1] = -.5 * square_ * square_ * g;
        jet.second[1] = square_ * per_q * (.25 * f + .5 * g);
      }
      if constexpr (n_orders > 2)
      {
        const double f3 = four * two * reduced[4], g3 = four * two * rho * reduced[5];
        jet.first[2] = -.5 * square_ * square_ * square_ * g3;
        jet.second[2] = square_ * square_ * per_q * (.25 * f3 + .5 * g3);
      }
      return jet;
    }

  private:
    static constexpr unsigned int n_functions = 6;

    double square_, inverse_;
    LocalPolynomials<n_functions> tables_; ///< f/ρ⁴, f'/ρ³, f''/ρ², g/ρ⁵, f₃/ρ⁶, g₃/ρ⁷
  };

  /// Those of a sum of powers without a horizon: c |ξ|^k → c |ξ|^(k+4) / ((k+2)² (k+4)²), and so
  /// on.
  class PowerJets
  {
  public:
    explicit PowerJets(const Kernel<2> &kernel);

    /// @param u  > 0
    template <unsigned int n_orders>
    PotentialJet at(double u) const
    {
      PotentialJet sum{};
      const double r = std::sqrt(u);
      for (const Term &term : terms_)
      {
        double power = 1; // r^k
        for (int k = 0; k < std::abs(term.exponent); ++k)
          power *= r;
        if (term.exponent < 0)
          power = 1 / power;
        sum.value += term.value * power * u * u;
        for (unsigned int k = 0; k < n_orders; ++k, power *= u)
        {
          sum.first[k] += term.first[k] * power * u;
          sum.second[k] += term.second[k] * power;
        }
      }
      return sum;
    }

    /// The highest power of |ξ| in any of them.
    unsigned int degree() const { return degree_; }

  private:
    struct Term
    {
      int exponent = 0;
      double value = 0, first[3] = {}, second[3] = {}; ///< factors
    };
    std::vector<Term> terms_;
    unsigned int degree_ = 0;
  };
} // namespace plumbline::physics
