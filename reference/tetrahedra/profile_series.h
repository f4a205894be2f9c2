#pragma once

#include "physics/radial_profile.h"

#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace plumbline::reference
{
  /// A polynomial of r by its powers, or a series of Chebyshev polynomials of 2 r - 1.
  template <class Real>
  struct RadialPolynomial
  {
    static constexpr unsigned int most_radii = 64; ///< at a time

    std::vector<Real> c; ///< at least one
    bool is_series = false;

    void evaluate(const Real *r, Real *values, unsigned int n) const;
    Real operator()(const Real &r) const { return is_series ? series_at(r) : powers_at(r); }

  private:
    Real powers_at(const Real &r) const;
    Real series_at(const Real &r) const;
  };

  /// t ρ(t) of a radial profile on [0, 1] as a Chebyshev series: the only approximation of a kernel
  /// that is not a sum of few powers. All functions that are derived from it are exact.
  struct ProfileSeries
  {
    explicit ProfileSeries(const physics::RadialProfile &profile);

    std::vector<double> coefficients;
    /// Bound in practice of ∫ t |t ρ - series| dt relative to ∫ t² ρ dt, which is the kernel's
    /// integral over its ball up to a constant; by values between the points of interpolation.
    double error = 0;
  };

  /// The parts of a bond tensor γ ê⊗ê as such series: t q, q = ∫_t^1 γ/s ds, and t w, w = γ - 3 q,
  /// see SolidKernel. If γ has a constant term at 0, both have a term t ln t, whose coefficients
  /// are known in closed form and are reduced smoothly towards the last one that is used. The
  /// moments ∫ t^n of this term have errors of 3e-13 (n = 1) and 1e-16 (n > 1).
  struct TensorSeries
  {
    explicit TensorSeries(const ProfileSeries &profile);

    std::vector<double> isotropic, directional;
  };

  /// The radial functions of PotentialPart as Chebyshev series, of t γ as one.
  struct PotentialSeries
  {
    /// Doubles that add up to a number of some 260 bits.
    using Number = std::array<double, 5>;
    using Series = std::vector<Number>;

    /// @param profile  coefficients of t γ
    /// @param order  n of PotentialPart
    PotentialSeries(const std::vector<double> &profile, int order);

    Series potential, of_edges, density; ///< r f, r g₁ and r g (regular)
    Series regular;                      ///< H / r
    Series compact;                      ///< -r² H / (1 - r)^(n+4)
    std::array<Number, 3> moments;       ///< ∫_0^1 r^k f r dr
  };

  template <class Real>
  void RadialPolynomial<Real>::evaluate(const Real *r, Real *values, unsigned int n) const
  {
    if constexpr (!std::is_same_v<Real, double>)
    {
      // not vectorised: sums of one radius stay in registers
      for (unsigned int q = 0; q < n; ++q)
        values[q] = (*this)(r[q]);
      return;
    }
    const std::size_t size = c.size();
    if (!is_series)
    {
      for (unsigned int q = 0; q < n; ++q)
        values[q] = c[size - 1];
      for (std::size_t j = size - 1; j-- > 0;)
        for (unsigned int q = 0; q < n; ++q)
          values[q] = values[q] * r[q] + c[j];
      return;
    }
    std::array<Real, most_radii> x, last; // filled up to n
    for (unsigned int q = 0; q < n; ++q)
    {
      x[q] = 4 * r[q] - 2;
      values[q] = last[q] = 0;
    }
    for (std::size_t j = size - 1; j > 0; --j)
      for (unsigned int q = 0; q < n; ++q)
      {
        const Real next = x[q] * values[q] + (c[j] - last[q]);
        last[q] = values[q];
        values[q] = next;
      }
    for (unsigned int q = 0; q < n; ++q)
      values[q] = x[q] * values[q] / 2 + (c[0] - last[q]);
  }

  template <class Real>
  Real RadialPolynomial<Real>::powers_at(const Real &r) const
  {
    Real value = c.back();
    for (std::size_t j = c.size() - 1; j-- > 0;)
      value = value * r + c[j];
    return value;
  }

  template <class Real>
  Real RadialPolynomial<Real>::series_at(const Real &r) const
  {
    const Real x = 4 * r - 2; // Clenshaw's recurrence
    Real value = 0, last = 0;
    for (std::size_t j = c.size() - 1; j > 0; --j)
    {
      const Real next = x * value + (c[j] - last);
      last = value;
      value = next;
    }
    return x * value / 2 + (c[0] - last);
  }
} // namespace plumbline::reference
