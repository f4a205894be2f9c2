#pragma once

#include "physics/kernel.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace plumbline::reference
{
  /// The kernel's entries at an offset, inlined for assembly: the profile by Horner's rule, one
  /// entry for scalar kernels, three (xx, xy, yy) for tensors.
  class RadialProfile
  {
  public:
    explicit RadialProfile(const physics::Kernel<2> &kernel)
        : is_tensor_(kernel.n_components() > 1), scale_(1 / kernel.horizon())
    {
      int highest = 0;
      for (const physics::PowerTerm &term : kernel.profile())
      {
        lowest_ = std::min(lowest_, term.exponent);
        highest = std::max(highest, term.exponent);
      }
      coefficients_.assign(highest - lowest_ + 1, 0.);
      for (const physics::PowerTerm &term : kernel.profile())
        coefficients_[term.exponent - lowest_] += kernel.constant() * term.coefficient;
      for (int e = lowest_; e <= highest; ++e)
        if (coefficients_[e - lowest_] != 0)
          is_even_ = is_even_ && e % 2 == 0 && e >= (is_tensor_ ? 2 : 0);
    }

    bool is_tensor() const { return is_tensor_; }
    unsigned int n_entries() const { return is_tensor_ ? 3 : 1; }

    /// The entries are polynomials of ξ: no kink, no singularity at 0.
    bool is_polynomial() const { return is_even_; }
    unsigned int degree() const { return static_cast<unsigned int>(coefficients_.size()) - 1; }
    bool is_constant() const { return is_even_ && !is_tensor_ && degree() == 0; }
    double constant() const { return coefficients_[0]; } ///< of constant kernels

    /// @param entries  shape (n_entries()); xi is not 0 unless the profile is polynomial
    template <int n_entries>
    void operator()(double xi, double eta, double *entries) const
    {
      const double square = xi * xi + eta * eta;
      double value = coefficients_[0];
      if (coefficients_.size() > 1 || lowest_ < 0)
      {
        const double t = std::sqrt(square) * scale_;
        value = 0;
        for (auto c = coefficients_.rbegin(); c != coefficients_.rend(); ++c)
          value = value * t + *c;
        for (int e = lowest_; e < 0; ++e)
          value /= t;
      }
      if constexpr (n_entries == 1)
        entries[0] = value;
      else
      {
        const double factor = square > 0 ? value / square : 0;
        entries[0] = factor * xi * xi;
        entries[1] = factor * xi * eta;
        entries[2] = factor * eta * eta;
      }
    }

  private:
    bool is_tensor_, is_even_ = true;
    double scale_;
    int lowest_ = 0;
    std::vector<double> coefficients_; ///< of t^(lowest + i)
  };

  /// Degree of a rule that integrates a function with a singularity at 0 over a region of a radius,
  /// whose centre is `distance` away, to a relative accuracy: the Bernstein ellipse.
  inline unsigned int degree_away_from_singularity(double distance, double radius, double accuracy)
  {
    const double ratio = std::max(1.05, distance / radius);
    return static_cast<unsigned int>(
        std::ceil(-std::log(accuracy) / std::log(ratio + std::sqrt(ratio * ratio - 1))));
  }
} // namespace plumbline::reference
