#pragma once

#include "physics/kernel.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace plumbline::reference
{
  /// The entries at an offset of a kernel whose profile has no breaks, inlined for assembly: powers
  /// by Horner's rule, one entry for scalar kernels, three (xx, xy, yy) for tensors.
  class SmoothEntries
  {
  public:
    /// @param profile  in place of the kernel's own
    SmoothEntries(const physics::Kernel<2> &kernel, const physics::RadialProfile &profile)
        : is_tensor_(kernel.n_components() > 1), is_even_(profile.is_even(is_tensor_)),
          is_function_(profile.is_function()), constant_(kernel.constant()),
          scale_(1 / kernel.horizon())
    {
      if (is_function_)
        function_ = profile;
      int highest = 0;
      const auto powers = is_function_ ? physics::RadialProfile::Powers{{0, 0}} : profile.powers();
      for (const physics::PowerTerm &term : powers)
      {
        lowest_ = std::min(lowest_, term.exponent);
        highest = std::max(highest, term.exponent);
      }
      coefficients_.assign(highest - lowest_ + 1, 0.);
      for (const physics::PowerTerm &term : powers)
        coefficients_[term.exponent - lowest_] += kernel.constant() * term.coefficient;
    }

    bool is_tensor() const { return is_tensor_; }
    unsigned int n_entries() const { return is_tensor_ ? 3 : 1; }

    /// The entries are smooth functions of ξ: no kink, no singularity at 0.
    bool is_smooth() const { return is_even_; }
    /// Of polynomials of |ξ| that the profile, or r times it where it is singular, is equal to on
    /// any interval of this length, to an accuracy (0: to round-off).
    unsigned int degree(double length, double accuracy = 0) const
    {
      if (!is_function_)
        return static_cast<unsigned int>(coefficients_.size()) - 1;
      return function_.degree(length * scale_, accuracy) +
             static_cast<unsigned int>(std::abs(function_.lowest_exponent()));
    }
    bool is_function() const { return is_function_; }
    /// The same of a function; 0 of powers.
    unsigned int degree_of_function(double length, double accuracy = 0) const
    {
      return !is_function_ ? 0 : function_.degree(length * scale_, accuracy);
    }
    /// The power that such a polynomial ends with, of the profile itself.
    int highest_exponent(double length) const
    {
      return !is_function_ ? static_cast<int>(coefficients_.size()) - 1 + lowest_
                           : static_cast<int>(function_.degree(length * scale_)) +
                                 function_.lowest_exponent();
    }
    bool is_constant() const
    {
      return is_even_ && !is_tensor_ && !is_function_ && coefficients_.size() == 1;
    }
    double constant() const { return coefficients_[0]; } ///< of constant kernels

    /// @param entries  shape (n_entries()); xi is not 0 unless the kernel is smooth there
    template <int n_entries>
    void operator()(double xi, double eta, double *entries) const
    {
      const double square = xi * xi + eta * eta;
      double value = coefficients_[0];
      if (is_function_)
        value = constant_ * function_(std::sqrt(square) * scale_);
      else if (coefficients_.size() > 1 || lowest_ < 0)
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
    bool is_tensor_, is_even_, is_function_;
    double constant_, scale_;
    int lowest_ = 0;
    std::vector<double> coefficients_; ///< of t^(lowest + i)
    physics::RadialProfile function_;  ///< in place of powers, if is_function_
  };

  /// A kernel as balls about a point: the integral of the kernel over any region is the sum of
  /// those of the balls' smooth entries over their parts of the region. One ball, unless the
  /// profile has breaks.
  class KernelEntries
  {
  public:
    struct Ball
    {
      double radius = 0; ///< [length]
      SmoothEntries entries;
    };

    explicit KernelEntries(const physics::Kernel<2> &kernel)
    {
      const double horizon = kernel.horizon();
      const auto pieces = kernel.profile().pieces();
      for (const auto &piece : pieces)
        whole_.push_back({piece.end * horizon, SmoothEntries(kernel, piece.profile)});
      for (const physics::Kernel<2> &part : kernel.parts())
        changes_.push_back({part.horizon(), SmoothEntries(part, part.profile())});
      is_tensor_ = last().is_tensor();
      has_breaks_ = whole_.size() > 1;
      is_smooth_ = !has_breaks_ && last().is_smooth();
      is_constant_ = !has_breaks_ && last().is_constant();
      constant_ = last().constant();
    }

    bool is_tensor() const { return is_tensor_; }
    unsigned int n_entries() const { return is_tensor_ ? 3 : 1; }
    bool has_breaks() const { return has_breaks_; }
    bool is_smooth() const { return is_smooth_; }
    bool is_constant() const { return is_constant_; }
    double constant() const { return constant_; } ///< of constant kernels
    bool is_function() const { return last().is_function(); }

    /// Radii of the circles where it is not smooth, the horizon among them, ascending.
    const std::vector<Ball> &circles() const { return whole_; }

    /// For a region at these distances from the point: calls integrate(radius, entries) for each
    /// ball that is needed.
    template <class Integrate>
    void for_balls(double nearest, double farthest, const Integrate &integrate) const
    {
      std::size_t i = 0;
      for (; i + 1 < whole_.size() && whole_[i].radius < farthest; ++i)
        if (whole_[i].radius > nearest) // a circle that cuts the region
          integrate(changes_[i].radius, changes_[i].entries);
      integrate(whole_[i].radius, whole_[i].entries);
    }

  private:
    const SmoothEntries &last() const { return whole_.back().entries; }

    std::vector<Ball> whole_;   ///< up to each break, all of the kernel
    std::vector<Ball> changes_; ///< what it loses there
    bool is_tensor_, has_breaks_, is_smooth_, is_constant_;
    double constant_;
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
