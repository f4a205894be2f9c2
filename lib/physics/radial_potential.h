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
  /// f/ρ⁴ and g/ρ⁵ are tables of polynomials in ρ, made once for a kernel (some 30 ms). Accuracy:
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
    double f(double rho) const { return power(rho, 4) * f_(rho); }
    double g(double rho) const { return power(rho, 5) * g_(rho); }

  private:
    static constexpr unsigned int n_terms = 10; ///< of a polynomial

    /// Polynomials on intervals of one length: short ones near the logarithm and at the circle,
    /// longer ones far outside.
    struct Table
    {
      double start = 0, length = 0;
      std::vector<double> coefficients; ///< shape (n_intervals, n_terms)

      double operator()(double rho) const
      {
        const double place = (rho - start) * (1 / length);
        const auto i = static_cast<unsigned int>(place);
        const double *const c = &coefficients[i * n_terms];
        const double x = 2 * (place - i) - 1;
        double value = c[n_terms - 1];
        for (unsigned int k = n_terms - 1; k-- > 0;)
          value = value * x + c[k];
        return value;
      }
    };
    struct Tables
    {
      Table far, near;

      double operator()(double rho) const { return rho < near.start ? far(rho) : near(rho); }
    };

    template <class Function>
    Tables tabulate(const Function &function) const;

    static double power(double rho, int n)
    {
      const double square = rho * rho;
      return n == 4 ? square * square : square * square * rho;
    }

    double horizon_, lowest_;
    Tables f_, g_; ///< over ρ⁴ and ρ⁵
  };
} // namespace plumbline::physics
