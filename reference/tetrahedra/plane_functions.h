#pragma once

#include "reference/tetrahedra/pair_lanes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace plumbline::reference
{
  /// A kernel's terms a t^k, k >= -1, that end at a radius. Lengths are in horizons.
  struct PotentialTerms
  {
    struct Term
    {
      double coefficient = 0; ///< of r^exponent
      int exponent = 0;
    };
    double end = 1;
    std::vector<Term> terms;
  };

  /// One part of a radial potential f with r f = ∫_r^end t γ (t - r)^n / n! dt, n = 1 or 3, and the
  /// functions of r that integrals over pairs of faces reduce it to, see ExactPairs:
  ///   g₁ = r⁻⁴ ∫ r³ f,  g = r⁻³ ∫ r² g₁,  H = ∫ r g,  so that  (r² H)''' = r f,
  /// integrated from 0 (regular), or from the end (compact: zero beyond the end).
  template <class Real>
  class PotentialPart
  {
  public:
    static constexpr unsigned int most_radii = 64; ///< at a time

    /// @param order  n
    PotentialPart(const PotentialTerms &kernel, int order);

    const Real &end() const { return end_; }

    /// Σ_j b_j r^j = r f for r < end.
    const std::vector<Real> &powers() const { return powers_; }
    /// b_j / (j + 3), of r g₁.
    const std::vector<Real> &powers_of_edges() const { return of_edges_; }
    /// ∫_0^end r^k f r dr, k = 0, 1, 2.
    const Real &moment(int k) const { return moments_[k]; }

    /// values += H, regular, at n radii on one side of the end.
    void add_regular(const Real *r, Real *values, unsigned int n, bool is_inside) const;
    /// values += H, compact, at n radii r = √(square + offset) in (0, end].
    void add_compact(const Real *squares, const Real &offset, Real *values, unsigned int n) const;
    /// g, regular.
    Real density(const Real &r) const;

    /// H, compact, in double.
    PieceForm compact_form() const;
    /// H, regular, in double, of a function of this part alone.
    PieceForm regular_form(bool is_inside) const;

  private:
    Real end_;
    int order_;
    std::vector<Real> powers_; ///< b
    std::vector<Real> of_edges_;
    std::vector<Real> regular_; ///< of H / r
    std::vector<Real> compact_; ///< of -r² H / (end - r)^(n+4), all of one sign if γ's are
    Real moments_[3] = {};
  };

  template <class Real>
  PotentialPart<Real>::PotentialPart(const PotentialTerms &kernel, int order)
      : end_(kernel.end), order_(order)
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
      // ∫_0^end of the binomial, and as n is odd besides ∫_0^r t γ (r - t)^n / n! dt
      const Real factor = coefficient;
      for (int j = 0; j <= order; ++j)
      {
        const int p = k + 2 + order - j;
        add(powers_, j,
            factor * (j % 2 == 0 ? 1 : -1) * power_of_end(p) /
                (factorial(j) * factorial(order - j) * p));
      }
      add(powers_, k + order + 2, factor * factorial(k + 1) / factorial(k + order + 2));
      // ∫_r^end t γ (t - r)^p / p! dt with t = (1 - σ) r + σ end and beta functions of σ
      const int p = order + 3;
      for (int j = 0; j <= k + 1; ++j)
        add(compact_, j,
            factor * power_of_end(k + 1 - j) * factorial(k + 1) * factorial(p + k + 1 - j) /
                (factorial(k + 1 - j) * factorial(p) * factorial(p + k + 2)));
    }
    for (std::size_t j = 0; j < powers_.size(); ++j)
    {
      const int n = static_cast<int>(j);
      of_edges_.push_back(powers_[j] / Real(n + 3));
      regular_.push_back(powers_[j] / Real((n + 1) * (n + 2) * (n + 3)));
      for (int l = 0; l < 3; ++l)
        moments_[l] += powers_[j] * power_of_end(n + l + 1) / Real(n + l + 1);
    }
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
    const std::size_t size = regular_.size();
    std::array<Real, most_radii> sum; // filled up to n
    for (unsigned int q = 0; q < n; ++q)
      sum[q] = regular_[size - 1];
    for (std::size_t j = size - 1; j-- > 0;)
      for (unsigned int q = 0; q < n; ++q)
        sum[q] = sum[q] * r[q] + regular_[j];
    for (unsigned int q = 0; q < n; ++q)
      values[q] += sum[q] * r[q];
  }

  template <class Real>
  void PotentialPart<Real>::add_compact(const Real *squares, const Real &offset, Real *values,
                                        unsigned int n) const
  {
    using std::sqrt;
    const std::size_t size = compact_.size();
    std::array<Real, most_radii> r, sum; // filled up to n
    for (unsigned int q = 0; q < n; ++q)
    {
      r[q] = sqrt(squares[q] + offset);
      sum[q] = compact_[size - 1];
    }
    for (std::size_t j = size - 1; j-- > 0;)
      for (unsigned int q = 0; q < n; ++q)
        sum[q] = sum[q] * r[q] + compact_[j];
    for (unsigned int q = 0; q < n; ++q)
    {
      const Real x = std::max(Real(0), Real(end_ - r[q])), x2 = x * x;
      values[q] -= sum[q] * (x2 * x2 * x) * (order_ == 3 ? x2 : Real(1)) / (squares[q] + offset);
    }
  }

  template <class Real>
  PieceForm PotentialPart<Real>::compact_form() const
  {
    PieceForm form;
    form.kind = PieceForm::Kind::compact;
    form.end = static_cast<double>(end_);
    form.power = order_ + 4;
    for (const Real &coefficient : compact_)
      form.c[form.n++] = static_cast<double>(coefficient);
    return form;
  }

  template <class Real>
  PieceForm PotentialPart<Real>::regular_form(bool is_inside) const
  {
    PieceForm form;
    form.kind = is_inside ? PieceForm::Kind::inside : PieceForm::Kind::outside;
    if (is_inside)
      for (const Real &coefficient : regular_)
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
    Real sum = 0;
    for (std::size_t j = powers_.size(); j-- > 0;)
      sum = sum * r + powers_[j] / static_cast<int>((j + 2) * (j + 3));
    return sum / r;
  }
} // namespace plumbline::reference
