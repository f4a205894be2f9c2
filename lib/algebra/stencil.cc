#include "algebra/stencil.h"

#include <algorithm>
#include <cmath>

namespace plumbline::algebra
{
  Stencil::Stencil(unsigned int n_blocks, int reach)
      : n_blocks_(n_blocks), reach_(reach),
        entries_(static_cast<std::size_t>(n_blocks) * n_blocks * (2 * reach + 1) * (2 * reach + 1))
  {
  }

  double &Stencil::operator()(unsigned int s, unsigned int t, int k1, int k2)
  {
    const std::size_t width = 2 * reach_ + 1;
    return entries_[((static_cast<std::size_t>(s) * n_blocks_ + t) * width + (k2 + reach_)) *
                        width +
                    (k1 + reach_)];
  }

  double Stencil::operator()(unsigned int s, unsigned int t, int k1, int k2) const
  {
    return const_cast<Stencil &>(*this)(s, t, k1, k2);
  }

  std::uint64_t Stencil::n_entries() const
  {
    constexpr double rounding = 1e-16; // of the largest: of sums that cancel
    double largest = 0;
    for (const double a : entries_)
      largest = std::max(largest, std::abs(a));
    return static_cast<std::uint64_t>(std::count_if(entries_.begin(), entries_.end(),
                                                    [=](double a)
                                                    { return std::abs(a) > rounding * largest; }));
  }

  bool Stencil::is_even() const
  {
    double largest = 0, defect = 0;
    for (unsigned int s = 0; s < n_blocks_; ++s)
      for (unsigned int t = 0; t < n_blocks_; ++t)
        for (int k2 = 0; k2 <= reach_; ++k2)
          for (int k1 = -reach_; k1 <= reach_; ++k1)
          {
            const double a = (*this)(s, t, k1, k2);
            largest = std::max(largest, std::abs(a));
            defect = std::max({defect, std::abs(a - (*this)(s, t, -k1, -k2)),
                               std::abs(a - (*this)(t, s, k1, k2))});
          }
    return defect <= 1e-14 * largest;
  }

  double Stencil::symmetry_defect() const
  {
    double largest = 0, defect = 0;
    for (unsigned int s = 0; s < n_blocks_; ++s)
      for (unsigned int t = 0; t <= s; ++t)
        for (int k2 = -reach_; k2 <= reach_; ++k2)
          for (int k1 = -reach_; k1 <= reach_; ++k1)
          {
            largest = std::max(largest, std::abs((*this)(s, t, k1, k2)));
            defect = std::max(defect, std::abs((*this)(s, t, k1, k2) - (*this)(t, s, -k1, -k2)));
          }
    return largest > 0 ? defect / largest : 0;
  }

  Stencil add(const Stencil &a, const Stencil &b)
  {
    Stencil sum(a.n_blocks(), std::max(a.reach(), b.reach()));
    for (const Stencil *term : {&a, &b})
      for (unsigned int s = 0; s < term->n_blocks(); ++s)
        for (unsigned int t = 0; t < term->n_blocks(); ++t)
          for (int k2 = -term->reach(); k2 <= term->reach(); ++k2)
            for (int k1 = -term->reach(); k1 <= term->reach(); ++k1)
              sum(s, t, k1, k2) += (*term)(s, t, k1, k2);
    return sum;
  }
} // namespace plumbline::algebra
