#pragma once

#include "physics/kernel.h"

#include <array>
#include <vector>

namespace plumbline::physics
{
  /// Radial potentials of a scalar kernel C in 2D as functions of u = |ξ|²: Ψ with Δ²Ψ = C, and Ψ₃
  /// with ΔΨ₃ = Ψ.
  struct PotentialJet
  {
    double value, first, second;    ///< Ψ, Ψ', Ψ''
    double next_first, next_second; ///< Ψ₃', Ψ₃''
  };

  /// Those that vanish with their derivatives at the horizon, so that they may be cut off there.
  /// With q = u/δ², ρ = 1 - q: Ψ = δ⁴ f(ρ), f = O(ρ⁴), and Ψ₃' = -½ δ⁴ g, g = O(ρ⁵), as
  /// RadialPotential has them; from the same Green's function
  ///   f' = ρ³/(16 q²) ∫_0^1 C τ² R(ρτ/q) dτ, R(x) = (x - ln(1 + x))/x²,
  ///   f'' = ρ²/(16 q²) ∫_0^1 C τ dτ, C at δ√(q + ρτ).
  /// Tables of polynomials in ρ. Accuracy: 1e-14 relative to ρ = .9, a test. Thread safe.
  class CircleJets
  {
  public:
    static constexpr double highest_rho = .96; ///< f has a logarithm at q = 0

    /// @param kernel      scalar, its profile without breaks
    /// @param lowest_rho  of arguments, < 0: 1 - (the largest |ξ| / δ)²
    CircleJets(const Kernel<2> &kernel, double lowest_rho);

    double square() const { return square_; } ///< δ²

    PotentialJet operator()(double u) const
    {
      const double rho = std::min(1 - u * inverse_, highest_rho), q = 1 - rho;
      const auto [f, f1, f2, g] = reduced(rho);
      const double square = rho * rho, value = square * square * f,
                   of_g = square * square * rho * g;
      return {square_ * square_ * value, -square_ * square * rho * f1, square * f2,
              -.5 * square_ * square_ * of_g, square_ * (.25 * value + .5 * of_g) / q};
    }

  private:
    static constexpr unsigned int n_terms = 10, n_functions = 4;
    static constexpr double knee = -1;

    using Values = std::array<double, n_functions>; ///< f/ρ⁴, f'/ρ³, f''/ρ², g/ρ⁵
    struct Table
    {
      double start = 0, per_length = 0;
      std::vector<std::array<Values, n_terms>> intervals; ///< coefficients
    };

    Values reduced(double rho) const
    {
      const Table &table = rho < knee ? far_ : near_;
      const double place = (rho - table.start) * table.per_length;
      const auto i = static_cast<unsigned int>(place);
      const auto &c = table.intervals[i];
      const double x = 2 * (place - i) - 1;
      Values result = c[n_terms - 1];
      for (unsigned int k = n_terms - 1; k-- > 0;)
        for (unsigned int j = 0; j < n_functions; ++j)
          result[j] = result[j] * x + c[k][j];
      return result;
    }

    template <class Function>
    static Table tabulate(double from, double to, double length, const Function &function);

    double square_, inverse_;
    Table far_, near_;
  };

  /// Those of a sum of powers without a horizon: c |ξ|^k → c |ξ|^(k+4) / ((k+2)² (k+4)²), and so
  /// on.
  class PowerJets
  {
  public:
    explicit PowerJets(const Kernel<2> &kernel);

    PotentialJet operator()(double u) const; ///< u > 0
    /// The highest power of |ξ| in what any of them is multiplied out to.
    unsigned int degree() const { return degree_; }

  private:
    struct Term
    {
      int exponent;
      double value, first, second, next_first, next_second; ///< factors of r^exponent
    };
    std::vector<Term> terms_;
    unsigned int degree_ = 0;
  };
} // namespace plumbline::physics
