#pragma once

#include "geometry/ball_cell.h"

namespace plumbline::geometry
{
  /// Convex, counter-clockwise, shape (n_vertices, 2) [length].
  using Polygon = std::vector<Point<2>>;

  double area(ArrayView<const Point<2>> polygon);

  /// The first vertex if the area is zero.
  Point<2> centroid(ArrayView<const Point<2>> polygon);

  /// Whether a point lies in a convex polygon or, to the rounding of the coordinates, on its
  /// boundary.
  bool contains(ArrayView<const Point<2>> polygon, const Point<2> &point);

  /// The part of a convex polygon to the left of the line from a to b; empty if that is thinner
  /// than the rounding of the coordinates. Accuracy: as `overlap`.
  Polygon left_of(ArrayView<const Point<2>> polygon, const Point<2> &a, const Point<2> &b);

  /// Intersection of two convex polygons; empty if they share no area (less than 1e-14 of the
  /// smaller one's). Accuracy: vertices to the rounding of their coordinates and, where two sides
  /// cross, to that over the sine of their angle. A vertex that is on a side to that rounding
  /// counts as on it, so that no slivers arise.
  Polygon overlap(ArrayView<const Point<2>> a, ArrayView<const Point<2>> b);

  /// Quadrature on a convex polygon, exact for polynomials of the given degree. Positive weights,
  /// points inside. Parallelograms: Gauss's product rule; others: the triangles of a fan, each with
  /// a symmetric rule of Witherden & Vincent 2015, doi:10.1016/j.camwa.2015.03.017, up to degree
  /// 14, and a collapsed product rule beyond.
  CutRule polygon_rule(ArrayView<const Point<2>> polygon, unsigned int degree);

  /// The view of a polygon as the functions above take it.
  inline ArrayView<const Point<2>> view(const Polygon &polygon)
  {
    return {polygon.data(), polygon.size()};
  }
} // namespace plumbline::geometry
