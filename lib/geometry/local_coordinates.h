#pragma once

#include "geometry/lattice.h"

#include <vector>

namespace plumbline::geometry
{
  /// Where coordinates count from, so that they keep their digits however far a body is from a
  /// user's origin: the lower corner of a box about the body; (0, 0) if that box is within eight
  /// times its longer side of the user's origin, where nothing is lost.
  Point<2> local_origin(const Box &box);

  /// x - origin, to the last decimal that double precision holds at both. So coordinates that are
  /// written as decimals come out as the same numbers wherever the body is: 5000000.35 - 5000000
  /// is .35.
  double local_coordinate(double x, double origin);

  /// The same of points, and of all corners. (0, 0) leaves them as they are.
  Point<2> local_point(const Point<2> &x, const Point<2> &origin);
  void move_to(const Point<2> &origin, std::vector<Point<2>> &points);
  void move_to(const Point<2> &origin, std::vector<Box> &boxes);
} // namespace plumbline::geometry
