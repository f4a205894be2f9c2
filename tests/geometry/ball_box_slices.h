// Ball ∩ box in quadruple precision, by another way than the library's: areas of disc ∩ rectangle,
// integrated over the height between those where the circle meets a side or a corner.
#pragma once

#include <quadmath.h>

#include <algorithm>
#include <array>
#include <vector>

namespace plumbline::geometry
{
  __extension__ typedef __float128 Quad;

  /// Of the disc of radius r about 0 with [0, x] × [0, y], odd in x and in y.
  inline Quad quadrant(Quad x, Quad y, Quad r)
  {
    const Quad sign = (x < 0) != (y < 0) ? -1 : 1;
    x = std::min(fabsq(x), r);
    y = std::min(fabsq(y), r);
    if (x * x + y * y <= r * r)
      return sign * x * y;
    const Quad of_x = sqrtq((r - x) * (r + x)), of_y = sqrtq((r - y) * (r + y));
    return sign * (x * of_x + y * of_y + r * r * (atan2q(x, of_x) - atan2q(of_y, y))) / 2;
  }

  /// Volume and its first moment along the last axis.
  /// @param lower, upper  corners of the box about the ball's centre
  inline std::array<Quad, 2> ball_box(const std::array<Quad, 3> &lower,
                                      const std::array<Quad, 3> &upper, Quad radius)
  {
    const Quad bottom = std::max(lower[2], -radius), top = std::min(upper[2], radius);
    if (bottom >= top)
      return {0, 0};
    std::vector<Quad> breaks{bottom, top};
    const auto add = [&](Quad square) // where the circle has this radius
    {
      if (square >= radius * radius)
        return;
      const Quad z = sqrtq(radius * radius - square);
      for (const Quad at : {-z, z})
        if (at > bottom && at < top)
          breaks.push_back(at);
    };
    for (const Quad x : {lower[0], upper[0]})
    {
      add(x * x);
      for (const Quad y : {lower[1], upper[1]})
        add(x * x + y * y);
    }
    for (const Quad y : {lower[1], upper[1]})
      add(y * y);
    std::sort(breaks.begin(), breaks.end());
    const Quad quarter = 2 * atanq(1); // of a turn
    std::array<Quad, 2> sum{};
    for (std::size_t k = 1; k < breaks.size(); ++k)
    {
      // the double exponential rule, to which roots at the ends do no harm
      const Quad half = (breaks[k] - breaks[k - 1]) / 2, middle = (breaks[k] + breaks[k - 1]) / 2;
      constexpr int n = 48;
      for (int i = -n; i <= n; ++i)
      {
        const Quad step = Quad(3.6) / n, t = i * step, u = quarter * sinhq(t),
                   z = middle + half * tanhq(u), r = sqrtq((radius - z) * (radius + z)),
                   area = quadrant(upper[0], upper[1], r) - quadrant(lower[0], upper[1], r) -
                          quadrant(upper[0], lower[1], r) + quadrant(lower[0], lower[1], r),
                   weight = half * step * quarter * coshq(t) / (coshq(u) * coshq(u));
        sum[0] += weight * area;
        sum[1] += weight * area * z;
      }
    }
    return sum;
  }
} // namespace plumbline::geometry
