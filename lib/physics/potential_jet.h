#pragma once

#include "physics/radial_potential.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
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

  /// Those of a bond tensor C ξ⊗ξ/|ξ|², whose potentials are Ψ_k 1 + H v_k with H = ξ⊗ξ - ½|ξ|² 1:
  /// of half its trace, and v of the rest.
  struct TensorJet : PotentialJet
  {
    double v[3] = {}, v_first[3] = {}, v_second[3] = {}; ///< v₂, v₃, v₄ and their derivatives
  };

  /// Those that vanish with their derivatives at the horizon, so that they may be cut off there.
  /// With q = u/δ², ρ = 1 - q: Ψ₂ = δ⁴ f(ρ), f = O(ρ⁴), as PotentialTables has it; from the same
  /// Green's function
  ///   f' = ρ³/(16 q²) ∫_0^1 C τ² R(ρτ/q) dτ, R(x) = (x - ln(1 + x))/x²,
  ///   f'' = ρ²/(16 q²) ∫_0^1 C τ dτ, C at δ√s, s = q + ρτ;
  /// Ψ_k = δ^2k f_k, f_(k+1)' = g_k/2, 2 q g_k = ∫_0^ρ f_k. Of bond tensors v_k = δ^(2k-2) f_k,
  ///   f' = ρ³/(96 q³) ∫_0^1 C τ² (2 s + q)/s dτ,  f'' = ρ²/(16 q⁴) ∫_0^1 C τ s dτ,
  /// f_(k+1)' = g_k, 4 q³ g_k = ∫_0^ρ (1 - σ)² f_k(σ) dσ (this g is not that of PotentialTables),
  /// q f_(k+1)'' = f_k/4 + 3 f_(k+1)'.
  /// Tables of polynomials in ρ. Accuracy: 1e-14 relative to ρ = .9, a test. Thread safe.
  /// @tparam n_parts  1: scalar kernels, 2: bond tensors
  template <unsigned int n_parts>
  class CircleJets
  {
  public:
    using Jet = std::conditional_t<n_parts == 1, PotentialJet, TensorJet>;

    /// @param kernel      its profile without breaks
    /// @param lowest_rho  of arguments, < 0: 1 - (the largest |ξ| / δ)²
    CircleJets(const Kernel<2> &kernel, double lowest_rho);

    double square() const { return square_; } ///< δ²

    /// @tparam n_orders  how many potentials, from Ψ₂ on
    template <unsigned int n_orders>
    Jet at(double u) const
    {
      const double rho = std::min(1 - u * inverse_, RadialPotential::highest_rho);
      const auto reduced = tables_.template first<n_needed(n_orders)>(rho);
      Jet jet;
      find_trace<n_orders>(rho, reduced, jet);
      if constexpr (n_parts == 2)
        find_rest<n_orders>(rho, reduced, jet);
      return jet;
    }

  private:
    /// Places of functions in the tables, and over what power of ρ: first those that are always
    /// needed.
    static constexpr unsigned int f = 0, f_first = 1, f_second = 2, g = 3; ///< 4, 3, 2, 5
    static constexpr unsigned int v = 4, v_first = 5, v_second = 6;        ///< 4, 3, 2
    static constexpr unsigned int v_g = 7, v3 = 8, v_g3 = 11, v4 = 12;     ///< 5, 6, 7, 8
    static constexpr unsigned int f3 = n_parts == 1 ? 4 : 9, g3 = f3 + 1;  ///< 6, 7
    static constexpr unsigned int n_functions = n_parts == 1 ? 6 : 13;

    static constexpr unsigned int n_needed(unsigned int n_orders) // whole vector registers
    {
      if (n_parts == 1)
        return n_orders < 3 ? 4 : n_functions;
      return n_orders == 1 ? 8 : n_orders == 2 ? 10 : n_functions;
    }

    using Values = typename LocalPolynomials<n_functions>::Values;

    template <unsigned int n_orders>
    void find_trace(double rho, const Values &reduced, PotentialJet &jet) const
    {
      const double per_q = 1 / (1 - rho), two = rho * rho, four = two * two;
      const double f_value = four * reduced[f];
      jet.value = square_ * square_ * f_value;
      jet.first[0] = -square_ * two * rho * reduced[f_first];
      jet.second[0] = two * reduced[f_second];
      if constexpr (n_orders > 1)
      {
        const double g_value = four * rho * reduced[g];
        jet.first[1] = -.5 * square_ * square_ * g_value;
        jet.second[1] = square_ * per_q * (.25 * f_value + .5 * g_value);
      }
      if constexpr (n_orders > 2)
      {
        const double f3_value = four * two * reduced[f3], g3_value = four * two * rho * reduced[g3];
        jet.first[2] = -.5 * square_ * square_ * square_ * g3_value;
        jet.second[2] = square_ * square_ * per_q * (.25 * f3_value + .5 * g3_value);
      }
    }

    template <unsigned int n_orders>
    void find_rest(double rho, const Values &reduced, TensorJet &jet) const
    {
      const double per_q = 1 / (1 - rho), two = rho * rho, four = two * two;
      const double v_value = four * reduced[v];
      jet.v[0] = square_ * v_value;
      jet.v_first[0] = -two * rho * reduced[v_first];
      jet.v_second[0] = inverse_ * two * reduced[v_second];
      if constexpr (n_orders > 1)
      {
        const double g_value = four * rho * reduced[v_g], v3_value = four * two * reduced[v3];
        jet.v[1] = square_ * square_ * v3_value;
        jet.v_first[1] = -square_ * g_value;
        jet.v_second[1] = per_q * (.25 * v_value + 3 * g_value);
        if constexpr (n_orders > 2)
        {
          const double g3_value = four * two * rho * reduced[v_g3];
          jet.v[2] = square_ * square_ * square_ * four * four * reduced[v4];
          jet.v_first[2] = -square_ * square_ * g3_value;
          jet.v_second[2] = square_ * per_q * (.25 * v3_value + 3 * g3_value);
        }
      }
    }

    double square_, inverse_;
    LocalPolynomials<n_functions> tables_;
  };

  /// Those of a sum of powers without a horizon: c |ξ|^k → c |ξ|^(k+4) / ((k+2)² (k+4)²), and so
  /// on; of bond tensors half of it for half the trace, and
  ///   v₂ = c |ξ|^(k+2) / (k (k+2) (k+4) (k+6)), c |ξ|² ln(|ξ|/δ) / 48 of k = 0,
  /// and so on by Δ(H r^p) = p (p + 4) H r^(p-2).
  /// @tparam n_parts  1: scalar kernels, 2: bond tensors
  template <unsigned int n_parts>
  class PowerJets
  {
  public:
    using Jet = typename CircleJets<n_parts>::Jet;

    /// @pre  a sum of powers
    explicit PowerJets(const Kernel<2> &kernel);

    /// @param u  > 0
    template <unsigned int n_orders>
    Jet at(double u) const
    {
      Jet sum{};
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
          if constexpr (n_parts == 2)
          {
            sum.v[k] += term.v[k] * power * u;
            sum.v_first[k] += term.v_first[k] * power;
            sum.v_second[k] += term.v_second[k] * power / u;
          }
        }
      }
      if constexpr (n_parts == 2)
        if (has_logarithm())
          add_logarithm<n_orders>(u, sum);
      return sum;
    }

    /// The highest power of |ξ| in any of them.
    unsigned int degree() const { return degree_; }

    /// They are no powers of |ξ| alone.
    bool has_logarithm() const { return logarithm_ != 0; }

  private:
    struct Term
    {
      int exponent = 0;
      double value = 0, first[3] = {}, second[3] = {}; ///< factors
      double v[3] = {}, v_first[3] = {}, v_second[3] = {};
    };
    void find_rest(double c, Term &term) const;

    /// v_(2+k) = (a ln(u/δ²) + b) u^(k+1), each with its derivatives.
    template <unsigned int n_orders>
    void add_logarithm(double u, Jet &sum) const
    {
      constexpr double a[3] = {1. / 2, 1. / 64, 1. / 3840},
                       b[3] = {0, -12. / 1024, -(12. / 1024 + 16. / 1920) / 60};
      const double log = std::log(u * per_square_);
      double power = logarithm_ / u;
      for (unsigned int k = 0; k < n_orders; ++k, power *= u)
      {
        const double p = k + 1., value = a[k] * log + b[k], first = p * value + a[k],
                     second = (p - 1) * first + p * a[k];
        sum.v[k] += value * power * u * u;
        sum.v_first[k] += first * power * u;
        sum.v_second[k] += second * power;
      }
    }

    std::vector<Term> terms_;
    double logarithm_ = 0; ///< of H r² ln(r/δ)
    double per_square_;    ///< 1/δ²
    unsigned int degree_ = 0;
  };
} // namespace plumbline::physics
