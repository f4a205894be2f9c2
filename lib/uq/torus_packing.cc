#include "uq/torus_packing.h"

#include <algorithm>
#include <cmath>

namespace plumbline::uq
{
  namespace
  {
    using Ellipse = Ellipses::Ellipse;

    /// A symmetric matrix of 2 × 2.
    struct Symmetric
    {
      double xx = 0, xy = 0, yy = 0;
    };

    Symmetric matrix(const std::array<double, 2> &semi_axes, const Ellipse &ellipse)
    {
      const double p = semi_axes[0] * semi_axes[0], q = semi_axes[1] * semi_axes[1];
      const double c = ellipse.cosine, s = ellipse.sine;
      return {p * c * c + q * s * s, (p - q) * c * s, p * s * s + q * c * c};
    }
  } // namespace

  bool meet(const std::array<double, 2> &semi_axes, const Ellipse &first, const Ellipse &second,
            double dx, double dy)
  {
    const auto [small, large] = std::minmax(semi_axes[0], semi_axes[1]);
    const double squared = dx * dx + dy * dy;
    if (squared > 4 * large * large)
      return false;
    if (squared <= 4 * small * small)
      return true;
    const Symmetric a = matrix(semi_axes, first), b = matrix(semi_axes, second);
    const auto contact = [&](double t)
    {
      const double xx = (1 - t) * a.xx + t * b.xx, xy = (1 - t) * a.xy + t * b.xy,
                   yy = (1 - t) * a.yy + t * b.yy;
      return t * (1 - t) * (yy * dx * dx - 2 * xy * dx * dy + xx * dy * dy) / (xx * yy - xy * xy);
    };
    // a concave function: its largest value by golden sections, known to rounding when they are
    // 1e-8 long
    constexpr double golden = .61803398874989485, shortest = 1e-8;
    double low = 0, high = 1, s = 1 - golden, t = golden, at_s = contact(s), at_t = contact(t);
    while (high - low > shortest)
    {
      if (std::max(at_s, at_t) > 1)
        return false;
      if (at_s > at_t)
      {
        high = t, t = s, at_t = at_s;
        at_s = contact(s = high - golden * (high - low));
      }
      else
      {
        low = s, s = t, at_s = at_t;
        at_t = contact(t = low + golden * (high - low));
      }
    }
    return std::max(at_s, at_t) <= 1;
  }

  TorusPacking::TorusPacking(const std::array<double, 2> &semi_axes, const Box &torus)
      : semi_axes_(semi_axes), torus_(torus)
  {
    constexpr double most_bins = 2000; // along x and y
    const double axis = 2 * std::max(semi_axes[0], semi_axes[1]);
    for (unsigned int d = 0; d < 2; ++d)
      n_bins_[d] = static_cast<int>(
          std::clamp(std::floor((torus.upper[d] - torus.lower[d]) / axis), 1., most_bins));
    bins_.resize(static_cast<std::size_t>(n_bins_[0]) * n_bins_[1]);
  }

  bool TorusPacking::add(const Ellipse &ellipse)
  {
    std::array<double, 2> side{};
    std::array<int, 2> at{};
    for (unsigned int d = 0; d < 2; ++d)
    {
      side[d] = torus_.upper[d] - torus_.lower[d];
      const double place = (ellipse.centre[d] - torus_.lower[d]) / side[d] * n_bins_[d];
      at[d] = static_cast<int>(std::clamp(place, 0., n_bins_[d] - 1.));
    }
    const auto bin = [&](int i, int j)
    {
      const int column = (i + n_bins_[0]) % n_bins_[0], row = (j + n_bins_[1]) % n_bins_[1];
      return static_cast<std::size_t>(row) * n_bins_[0] + column;
    };
    for (int j = at[1] - 1; j <= at[1] + 1; ++j)
      for (int i = at[0] - 1; i <= at[0] + 1; ++i)
        for (const Ellipse &other : bins_[bin(i, j)])
        {
          const double dx = other.centre[0] - ellipse.centre[0],
                       dy = other.centre[1] - ellipse.centre[1];
          // the nearest of its images: others are more than four semi-axes away
          if (meet(semi_axes_, ellipse, other, dx - side[0] * std::round(dx / side[0]),
                   dy - side[1] * std::round(dy / side[1])))
            return false;
        }
    bins_[bin(at[0], at[1])].push_back(ellipse);
    return true;
  }
} // namespace plumbline::uq
