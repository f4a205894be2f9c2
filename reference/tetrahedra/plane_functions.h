#pragma once

#include "reference/tetrahedra/pair_lanes.h"
#include "reference/tetrahedra/profile_series.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace plumbline::reference
{
  /// A kernel's terms a t^k, k >= -1, that end at a radius; or t γ as a series that ends at 1, see
  /// ProfileSeries. Lengths are in horizons.
  struct PotentialTerms
  {
    struct Term
    {
      double coefficient = 0; ///< of r^exponent
      int exponent = 0;
    };
    double end = 1;
    std::vector<Term> terms;
    std::vector<double> series; ///< else empty
    /// Degrees of polynomials equal to the series, on intervals of length 1, 1/2, ...
    std::vector<unsigned int> degrees;
  };

  /// One part of a radial potential f with r f = ∫_r^end t γ (t - r)^n / n! dt, n = 1 to 3, and the
  /// functions of r that integrals over pairs of faces reduce it to, see ExactPairs:
  ///   g₁ = r⁻⁴ ∫ r³ f,  g = r⁻³ ∫ r² g₁,  H = ∫ r g,  so that  (r² H)''' = r f,
  /// integrated from 0 (regular), or from the end (compact: zero beyond the end).
  template <class Real>
  class PotentialPart
  {
  public:
    static constexpr unsigned int most_radii = RadialPolynomial<Real>::most_radii; ///< at a time

    /// @param order  n
    PotentialPart(const PotentialTerms &kernel, int order);

    const Real &end() const { return end_; }

    /// r f for r < end.
    const RadialPolynomial<Real> &potential() const { return potential_; }
    /// r g₁.
    const RadialPolynomial<Real> &of_edges() const { return of_edges_; }
    /// ∫_0^end r^k f r dr, k = 0, 1, 2.
    const Real &moment(int k) const { return moments_[k]; }

    /// values += H, regular, at n radii on one side of the end.
    void add_regular(const Real *r, Real *values, unsigned int n, bool is_inside) const;
    /// values += H, compact, at n radii r = √(square + offset) in (0, end].
    void add_compact(const Real *squares, const Real &offset, Real *values, unsigned int n) const;
    /// g, regular.
    Real density(const Real &r) const;

    /// Gauss points that series take besides those of powers, on a piece of this length.
    unsigned int extra_points(double length) const;
    /// The round-off of compact H, relative to that of Real, where it exceeds that of the value:
    /// series, and powers that cancel, have the round-off of their largest terms. Else 0.
    Real size_of_compact(const Real &r) const;
    /// The same of κ ∫ H / (κ² + τ²) dτ, r² = κ² + τ² + height.
    Real size_of_piece(const Real &kappa, const Real &from, const Real &to,
                       const Real &height) const;
    /// The same of regular functions, relative to their values.
    const Real &growth() const { return growth_; }

    /// H, compact, in double.
    PieceForm compact_form() const;
    /// H, regular, in double, of a function of this part alone.
    PieceForm regular_form(bool is_inside) const;

  private:
    void set_powers(const PotentialTerms &kernel);
    void set_size_of_powers();
    void set_series(const PotentialTerms &kernel);

    Real end_;
    int order_;
    RadialPolynomial<Real> potential_, of_edges_, density_; ///< r f, r g₁, r g
    RadialPolynomial<Real> regular_;                        ///< H / r
    /// -r² H / (end - r)^(n+4), coefficients all of one sign if those of powers of γ are
    RadialPolynomial<Real> compact_;
    Real moments_[3] = {};
    std::vector<unsigned int> degrees_;
    Real compact_size_ = 0, growth_ = 1; ///< size 0: round-off is that of the values
  };

  template <class Real>
  PotentialPart<Real>::PotentialPart(const PotentialTerms &kernel, int order)
      : end_(kernel.end), order_(order), degrees_(kernel.degrees)
  {
    if (kernel.series.empty())
      set_powers(kernel);
    else
      set_series(kernel);
  }

  template <class Real>
  void PotentialPart<Real>::set_series(const PotentialTerms &kernel)
  {
    const auto number = [](const PotentialSeries::Number &parts)
    {
      Real sum = 0;
      for (std::size_t k = parts.size(); k-- > 0;)
        sum += Real(parts[k]);
      return sum;
    };
    const auto series = [&number](const PotentialSeries::Series &from)
    {
      RadialPolynomial<Real> result{{}, true};
      for (const PotentialSeries::Number &c : from)
        result.c.push_back(number(c));
      return result;
    };
    const auto size = [](const RadialPolynomial<Real> &f)
    {
      using std::abs;
      Real sum = 0;
      for (const Real &c : f.c)
        sum += abs(c);
      return sum;
    };
    const PotentialSeries all(kernel.series, order_);
    potential_ = series(all.potential);
    of_edges_ = series(all.of_edges);
    density_ = series(all.density);
    regular_ = series(all.regular);
    compact_ = series(all.compact);
    for (std::size_t k = 0; k < all.moments.size(); ++k)
      moments_[k] = number(all.moments[k]);
    compact_size_ = size(compact_);
    using std::abs;
    growth_ = size(regular_) / std::min(abs(regular_(Real(0))), abs(regular_(Real(1))));
  }

  template <class Real>
  void PotentialPart<Real>::set_powers(const PotentialTerms &kernel)
  {
    const auto factorial = [](int n)
    {
      Real product = 1;
      for (int j = 2; j <= n; ++j)
        product *= j;
      return product;
    };
    const auto power_of_end = [this](int n)
    {
      Real power = 1;
      for (; n > 0; --n)
        power *= end_;
      return power;
    };
    const auto add = [](std::vector<Real> &powers, int place, const Real &value)
    {
      if (powers.size() <= static_cast<std::size_t>(place))
        powers.resize(static_cast<std::size_t>(place) + 1);
      powers[static_cast<std::size_t>(place)] += value;
    };
    for (const auto &[coefficient, k] : kernel.terms)
    {
      // ∫_0^end of the binomial, less (-1)^n ∫_0^r t γ (r - t)^n / n! dt
      const Real factor = coefficient;
      for (int j = 0; j <= order_; ++j)
      {
        const int p = k + 2 + order_ - j;
        add(potential_.c, j,
            factor * (j % 2 == 0 ? 1 : -1) * power_of_end(p) /
                (factorial(j) * factorial(order_ - j) * p));
      }
      add(potential_.c, k + order_ + 2,
          factor * (order_ % 2 == 0 ? -1 : 1) * factorial(k + 1) / factorial(k + order_ + 2));
      // ∫_r^end t γ (t - r)^p / p! dt with t = (1 - σ) r + σ end and beta functions of σ
      const int p = order_ + 3;
      for (int j = 0; j <= k + 1; ++j)
        add(compact_.c, j,
            factor * power_of_end(k + 1 - j) * factorial(k + 1) * factorial(p + k + 1 - j) /
                (factorial(k + 1 - j) * factorial(p) * factorial(p + k + 2)));
    }
    set_size_of_powers();
    for (std::size_t j = 0; j < potential_.c.size(); ++j)
    {
      const int n = static_cast<int>(j);
      const Real &power = potential_.c[j];
      of_edges_.c.push_back(power / Real(n + 3));
      density_.c.push_back(power / Real((n + 2) * (n + 3)));
      regular_.c.push_back(power / Real((n + 1) * (n + 2) * (n + 3)));
      for (int l = 0; l < 3; ++l)
        moments_[l] += power * power_of_end(n + l + 1) / Real(n + l + 1);
    }
  }

  template <class Real>
  void PotentialPart<Real>::set_size_of_powers()
  {
    using std::abs;
    constexpr int n_samples = 16;
    constexpr double usual = 32; // round-off that other terms have, too
    Real size = 0, power = 1;
    for (const Real &coefficient : compact_.c)
    {
      size += abs(coefficient) * power;
      power *= end_;
    }
    Real least = size;
    for (int k = 0; k <= n_samples; ++k)
      least = std::min(least, Real(abs(compact_(end_ * k / n_samples))));
    if (size > usual * least)
      compact_size_ = size;
  }

  template <class Real>
  void PotentialPart<Real>::add_regular(const Real *r, Real *values, unsigned int n,
                                        bool is_inside) const
  {
    if (!is_inside)
    {
      const Real half = moments_[0] / 2, last = moments_[2] / 2;
      for (unsigned int q = 0; q < n; ++q)
      {
        const Real inverse = 1 / r[q];
        values[q] += half + inverse * (last * inverse - moments_[1]);
      }
      return;
    }
    std::array<Real, most_radii> sum; // filled up to n
    regular_.evaluate(r, sum.data(), n);
    for (unsigned int q = 0; q < n; ++q)
      values[q] += sum[q] * r[q];
  }

  template <class Real>
  void PotentialPart<Real>::add_compact(const Real *squares, const Real &offset, Real *values,
                                        unsigned int n) const
  {
    using std::sqrt;
    std::array<Real, most_radii> r, sum; // filled up to n
    r[0] = 0;
    for (unsigned int q = 0; q < n; ++q)
      r[q] = sqrt(squares[q] + offset);
    compact_.evaluate(r.data(), sum.data(), n);
    for (unsigned int q = 0; q < n; ++q)
    {
      const Real x = std::max(Real(0), Real(end_ - r[q])), x2 = x * x;
      values[q] -= sum[q] * (x2 * x2 * x) * (order_ == 3 ? x2 : Real(1)) / (squares[q] + offset);
    }
  }

  template <class Real>
  unsigned int PotentialPart<Real>::extra_points(double length) const
  {
    if (degrees_.empty())
      return 0;
    std::size_t level = 0;
    while (level + 1 < degrees_.size() && std::ldexp(1, -static_cast<int>(level) - 1) >= length)
      ++level;
    // degrees are those to the digits of double; coefficients decay at least as fast beyond
    constexpr unsigned int usual = std::numeric_limits<double>::digits,
                           digits = std::numeric_limits<Real>::digits;
    return std::min(degrees_[level] * digits / usual, degrees_.front()) / 2 + 1;
  }

  template <class Real>
  Real PotentialPart<Real>::size_of_compact(const Real &r) const
  {
    if (compact_size_ == 0 || !(r < end_) || !(r > 0))
      return 0;
    const Real x = end_ - r, x2 = x * x;
    return compact_size_ * (x2 * x2 * x) * (order_ == 3 ? x2 : Real(1)) / (r * r);
  }

  template <class Real>
  Real PotentialPart<Real>::size_of_piece(const Real &kappa, const Real &from, const Real &to,
                                          const Real &height) const
  {
    using std::abs;
    using std::sqrt;
    if (compact_size_ == 0)
      return 0;
    constexpr double most_angle = 3.15;
    const Real nearest = std::max({Real(0), from, Real(-to)}),
               square = kappa * kappa + nearest * nearest,
               angle = std::min(Real(abs(kappa) * (to - from) / square), Real(most_angle));
    return angle * size_of_compact(sqrt(square + height));
  }

  template <class Real>
  PieceForm PotentialPart<Real>::compact_form() const
  {
    PieceForm form;
    form.is_series = compact_.is_series;
    form.kind = PieceForm::Kind::compact;
    form.end = static_cast<double>(end_);
    form.power = order_ + 4;
    for (const Real &coefficient : compact_.c)
      form.c[form.n++] = static_cast<double>(coefficient);
    return form;
  }

  template <class Real>
  PieceForm PotentialPart<Real>::regular_form(bool is_inside) const
  {
    PieceForm form;
    form.kind = is_inside ? PieceForm::Kind::inside : PieceForm::Kind::outside;
    form.is_series = is_inside && regular_.is_series;
    if (is_inside)
      for (const Real &coefficient : regular_.c)
        form.c[form.n++] = static_cast<double>(coefficient);
    else
      for (const Real &coefficient :
           {Real(moments_[2] / 2), Real(-moments_[1]), Real(moments_[0] / 2)})
        form.c[form.n++] = static_cast<double>(coefficient);
    return form;
  }

  template <class Real>
  Real PotentialPart<Real>::density(const Real &r) const
  {
    if (!(r < end_))
      return (moments_[1] - moments_[2] / r) / (r * r * r);
    return density_(r) / r;
  }
} // namespace plumbline::reference
