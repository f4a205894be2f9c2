#include "algebra/stencil.h"

#include <algorithm>
#include <cmath>

namespace plumbline::algebra
{
  namespace
  {
    std::size_t n_offsets(const std::array<int, 3> &reaches)
    {
      std::size_t n = 1;
      for (const int reach : reaches)
        n *= 2 * reach + 1;
      return n;
    }
  } // namespace

  Stencil::Stencil(unsigned int n_blocks, int reach) : Stencil(n_blocks, {reach, reach, 0}) {}

  Stencil::Stencil(unsigned int n_blocks, const std::array<int, 3> &reaches)
      : n_blocks_(n_blocks), reaches_(reaches),
        entries_(static_cast<std::size_t>(n_blocks) * n_blocks * n_offsets(reaches))
  {
  }

  double &Stencil::operator()(unsigned int s, unsigned int t, int k1, int k2, int k3)
  {
    const std::size_t block = static_cast<std::size_t>(s) * n_blocks_ + t;
    const std::size_t plane = block * (2 * reaches_[2] + 1) + (k3 + reaches_[2]);
    const std::size_t row = plane * (2 * reaches_[1] + 1) + (k2 + reaches_[1]);
    return entries_[row * (2 * reaches_[0] + 1) + (k1 + reaches_[0])];
  }

  double Stencil::operator()(unsigned int s, unsigned int t, int k1, int k2, int k3) const
  {
    return const_cast<Stencil &>(*this)(s, t, k1, k2, k3);
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
        for_each_offset(
            [&](int k1, int k2, int k3)
            {
              const double a = (*this)(s, t, k1, k2, k3);
              largest = std::max(largest, std::abs(a));
              defect = std::max({defect, std::abs(a - (*this)(s, t, -k1, -k2, -k3)),
                                 std::abs(a - (*this)(t, s, k1, k2, k3))});
            });
    return defect <= 1e-14 * largest;
  }

  double Stencil::symmetry_defect() const
  {
    double largest = 0, defect = 0;
    for (unsigned int s = 0; s < n_blocks_; ++s)
      for (unsigned int t = 0; t <= s; ++t)
        for_each_offset(
            [&](int k1, int k2, int k3)
            {
              const double a = (*this)(s, t, k1, k2, k3);
              largest = std::max(largest, std::abs(a));
              defect = std::max(defect, std::abs(a - (*this)(t, s, -k1, -k2, -k3)));
            });
    return largest > 0 ? defect / largest : 0;
  }

  Stencil add(const Stencil &a, const Stencil &b)
  {
    std::array<int, 3> reaches{};
    for (unsigned int d = 0; d < 3; ++d)
      reaches[d] = std::max(a.reaches()[d], b.reaches()[d]);
    Stencil sum(a.n_blocks(), reaches);
    for (const Stencil *term : {&a, &b})
      for (unsigned int s = 0; s < term->n_blocks(); ++s)
        for (unsigned int t = 0; t < term->n_blocks(); ++t)
          term->for_each_offset([&](int k1, int k2, int k3)
                                { sum(s, t, k1, k2, k3) += (*term)(s, t, k1, k2, k3); });
    return sum;
  }
} // namespace plumbline::algebra
