#pragma once

#include "geometry/pair_position.h"

#include <algorithm>
#include <cmath>

namespace plumbline::reference
{
  using dealii::Point;
  using Vector2 = dealii::Tensor<1, 2>;

  inline double cross(const Vector2 &a, const Vector2 &b)
  {
    return a[0] * b[1] - a[1] * b[0];
  }

  /// A side of cells: start + σ along, 0 <= σ <= 1.
  struct Segment
  {
    Segment(const Point<2> &from, const Point<2> &to) : start(from), end(to), along(to - from) {}

    Point<2> middle() const { return start + .5 * along; }

    Point<2> start, end;
    Vector2 along;
  };

  /// |z + x along|² = c + 2 b x + a x².
  struct SquaredDistance
  {
    SquaredDistance(const Vector2 &z, const Vector2 &along)
        : a(along.norm_square()), b(z * along), c(z.norm_square())
    {
    }

    double operator()(double x) const { return c + (2 * b + a * x) * x; }

    /// Not positive: it is a square nowhere.
    double discriminant(double square) const { return b * b - a * (c - square); }

    /// The part of from <= x <= to where it is less than a square: equal ends if there is none.
    std::array<double, 2> below(double square, double from, double to) const
    {
      const double crossed = discriminant(square), root = crossed > 0 ? std::sqrt(crossed) : 0;
      return {std::clamp((-b - root) / a, from, to), std::clamp((-b + root) / a, from, to)};
    }

    double a = 0, b = 0, c = 0;
  };

  /// Where two sets stand to a horizon, by circles about them: what may be cut is.
  /// @param both  the sum of the circles' radii
  inline geometry::PairPosition position_of_circles(double between, double both, double horizon)
  {
    using geometry::PairPosition;
    return between - both >= horizon   ? PairPosition::apart
           : between + both <= horizon ? PairPosition::inside
                                       : PairPosition::cut;
  }
} // namespace plumbline::reference
