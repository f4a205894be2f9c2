#pragma once

#include <deal.II/base/array_view.h>
#include <deal.II/base/point.h>

#include <array>

namespace plumbline::geometry
{
  using dealii::ArrayView;
  using dealii::Point;

  /// Where the pairs of points of two sets stand to a horizon.
  enum class PairPosition : char
  {
    inside, ///< all are within it
    cut,    ///< by it; also what may be anything
    apart   ///< none is nearer
  };

  /// What exact predicates say of a decision that was made in double precision.
  enum class Verdict : char
  {
    right,
    open, ///< taken as cut, which holds for all pairs, but is none
    tie,  ///< not as exact predicates have it, but it is for a horizon that differs by rounding
    wrong
  };

  /// Of ties, in horizons: rounding of coordinates' differences, squares and roots.
  constexpr double tie_width = 1e-13;

  /// Where two convex polygons or segments (two vertices) stand, in exact arithmetic on the given
  /// doubles. Cost: some 20 µs, ties 10 times that.
  /// @pre  they are the same, or have no inner points in common
  PairPosition exact_position(ArrayView<const Point<2>> a, ArrayView<const Point<2>> b,
                              double horizon);

  /// Of a decision about them.
  Verdict judge(PairPosition taken, ArrayView<const Point<2>> a, ArrayView<const Point<2>> b,
                double horizon);

  /// Of the part of a segment that was taken to lie in a circle.
  /// @param part  of from + s (to - from), 0 <= s <= 1; equal ends if there is none
  Verdict judge_part(const std::array<double, 2> &part, const Point<2> &centre, double radius,
                     const Point<2> &from, const Point<2> &to);
} // namespace plumbline::geometry
