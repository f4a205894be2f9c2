#pragma once

#include "physics/kernel.h"

#include <vector>

namespace plumbline::physics
{
  /// The radial functions that turn double integrals of a scalar kernel C in 2D into integrals over
  /// sides of cells. With q = |ξ|²/δ² and ρ = 1 - q:
  ///   Ψ = δ⁴ f(ρ), Δ²Ψ = C in the ball and beyond it, where C goes on by its formula, with
  ///   f = O(ρ⁴) at the circle, so that Ψ cut off there, on either side, is as smooth as C allows;
  ///   div (ξ δ⁴ g(ρ)) = -Ψ with g = O(ρ⁵).
  /// From Green's function of the operator D = d/dq (q d/dq), Δ = (4/δ²) D:
  ///   16 f = ∫_q^1 C(δ√s) [(s + q) ln(s/q) - 2 (s - q)] ds,   2 q g = ∫_q^1 f ds.
  /// f/ρ⁴ and g/ρ⁵ are tables of polynomials in ρ, made once for a kernel (some 10 ms). Accuracy:
  /// 1e-14 relative for ρ < .9, 1e-13 up to highest_rho: a test. Thread safe.
  class RadialPotential
  {
  public:
    static constexpr double highest_rho = .96; ///< f has a logarithm at q = 0

    /// @param kernel      scalar, its profile without breaks
    /// @param lowest_rho  of arguments, < 0: 1 - (the largest |ξ| / δ)²
    RadialPotential(const Kernel<2> &kernel, double lowest_rho);

    double horizon() const { return horizon_; }
    double lowest_rho() const { return lowest_; }

    /// f, for lowest_rho <= ρ <= highest_rho. [1 / length^4 times the unit of the operator]
    double f(double rho) const { return power(rho, 4) * reduced(f_, rho); }
    double g(double rho) const { return power(rho, 5) * reduced(g_, rho); }

  private:
    static constexpr unsigned int n_terms = 10;      ///< of a polynomial
    static constexpr double per_interval = 1. / 128; ///< length of one, in ρ

    using Table = std::vector<double>; ///< shape (n_intervals, n_terms)

    template <class Function>
    Table tabulate(const Function &function) const;

    static double power(double rho, int n)
    {
      const double square = rho * rho;
      return n == 4 ? square * square : square * square * rho;
    }

    double reduced(const Table &table, double rho) const
    {
      const double place = (rho - lowest_) * (1 / per_interval);
      const auto i = static_cast<unsigned int>(place);
      const double *const c = &table[i * n_terms];
      const double x = 2 * (place - i) - 1;
      double value = c[n_terms - 1];
      for (unsigned int k = n_terms - 1; k-- > 0;)
        value = value * x + c[k];
      return value;
    }

    double horizon_, lowest_;
    std::size_t n_intervals_;
    Table f_, g_;
  };
} // namespace plumbline::physics
