#pragma once

#include "geometry/convex_polyhedron.h"

namespace plumbline::geometry
{
  struct SolidBall
  {
    dealii::Point<3> centre; ///< [length]
    double radius = 0;       ///< > 0 [length]
  };

  /// Volume, centroid and second moments of ball ∩ cell; where the volume is 0, the centroid is the
  /// point of the cell nearest to the ball's centre.
  /// @param degree  0, 1 or 2: the highest moment; above it nothing is specified
  /// @throws InputError  radius <= 0 or not finite
  /// Accuracy: relative to min(|ball|, |cell|) and its diameter, 1e-14 for every position,
  /// tangency, corners and edges on the sphere included, and for radii from a tenth of the cell to
  /// a thousand of it, if its width is at least .3 of its length. Slender cells lose digits where
  /// the centre is near: up to 2e-12 (boxes 1 x .01 x .01), 2e-10 (1 x .001 x .001).
  /// Not for: cells with curved faces (split them) or that are not convex.
  /// Method: the divergence theorem makes of the moments sums over the faces, and over the part of
  /// the sphere inside the cell; Green's theorem in the planes and Stokes' theorem on the sphere
  /// make sums over segments and arcs of those, which both sides share. Boxes with faces
  /// normal to the axes have their own algorithm up to degree 1, see ball_box.h.
  SolidMoments intersect(const SolidBall &ball, const ConvexPolyhedron &cell,
                         unsigned int degree = 2);
} // namespace plumbline::geometry
