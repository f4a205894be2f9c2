#pragma once

#include "geometry/ball_cell.h"

#include <vector>

namespace plumbline::geometry
{
  /// The boundary of ball ∩ polygon relative to `origin`, counter-clockwise from any of its
  /// corners. Everything is decided and constructed in exact arithmetic on the given doubles; the
  /// end points of the pieces are rounded once, after `origin` is subtracted.
  /// @pre the ball and the polygon are what `boundary` allows
  /// Cost: some 60 µs for a square.
  std::vector<Piece> exact_boundary(const Ball &ball, ArrayView<const Point<2>> vertices,
                                    const Point<2> &origin);
} // namespace plumbline::geometry
