#pragma once

#include "geometry/visibility.h"

namespace plumbline::geometry
{
  /// Whether a bond from x to y meets a crack, ends apart.
  inline bool crosses(const Cut &cut, const Point<2> &x, const Point<2> &y)
  {
    const auto side = [](const Point<2> &a, const Point<2> &b, const Point<2> &c)
    { return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0; };
    return side(cut[0], cut[1], x) != side(cut[0], cut[1], y) &&
           side(x, y, cut[0]) != side(x, y, cut[1]);
  }
} // namespace plumbline::geometry
