#pragma once

#include <deal.II/base/point.h>

#include <algorithm>
#include <utility>

namespace plumbline::geometry
{
  /// [lower, upper] on a line.
  struct Interval
  {
    double lower = 0, upper = 0; ///< [length]
  };

  /// The ball of a line, [centre - radius, centre + radius].
  struct LineBall
  {
    dealii::Point<1> centre;
    double radius = 0;
  };

  /// Length and centroid of ball ∩ interval, which is an interval; length 0: they do not overlap.
  inline std::pair<double, dealii::Point<1>> intersect(const LineBall &ball, const Interval &piece)
  {
    const double lower = std::max(piece.lower, ball.centre[0] - ball.radius),
                 upper = std::min(piece.upper, ball.centre[0] + ball.radius);
    if (!(lower < upper))
      return {0, ball.centre};
    return {upper - lower, dealii::Point<1>(lower + (upper - lower) / 2)};
  }
} // namespace plumbline::geometry
