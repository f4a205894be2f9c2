#pragma once

#include "geometry/ball_polyhedron.h"

namespace plumbline::geometry
{
  /// Volume and centroid of ball ∩ box with faces normal to the axes, as intersect() of a
  /// polyhedron gives them and as accurately, in a fraction of the time: no topology but a box's,
  /// no memory.
  /// @param ball   radius > 0, finite [length]
  /// @param whole  what is known of the box
  /// Not for: second moments, which are left at 0 unless the ball holds the whole box.
  SolidMoments intersect_box(const SolidBall &ball, const dealii::Point<3> &lower,
                             const dealii::Point<3> &upper, const SolidMoments &whole);
} // namespace plumbline::geometry
