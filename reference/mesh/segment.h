#pragma once

#include <deal.II/base/point.h>

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
} // namespace plumbline::reference
