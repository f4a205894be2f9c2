#pragma once

#include "geometry/cracks.h"
#include "geometry/polygon.h"

namespace plumbline::geometry
{
  /// The two ends of a straight crack, which no bond passes.
  using Cut = std::array<Point<2>, 2>;

  /// Of cracks with corners, side by side.
  std::vector<Cut> straight_parts(const std::vector<Polyline> &cracks);

  /// Of one convex polygon from another.
  enum class Sight
  {
    clear,
    partial, ///< some of it from some points
    hidden   ///< behind one straight crack
  };

  /// Those cracks that some line from a point of one convex polygon to one of the other meets;
  /// touching their hull is none.
  /// @param between  overwritten
  Sight find_between(const std::vector<Cut> &cracks, ArrayView<const Point<2>> a,
                     ArrayView<const Point<2>> b, std::vector<Cut> &between);

  /// What of a convex polygon is seen from a point past cracks, as convex polygons without a
  /// common area. From a point on a crack its right side is seen.
  /// @param seen  overwritten
  /// Accuracy: as left_of.
  void find_visible(const Point<2> &from, ArrayView<const Point<2>> polygon,
                    const std::vector<Cut> &cracks, std::vector<Polygon> &seen);

  /// Whether a point comes as near as `reach` to a line through the end of a crack and a vertex of
  /// a polygon or another end: what is seen of the polygon changes its form there.
  bool is_at_shadow(const Point<2> &x, double reach, const std::vector<Cut> &cracks,
                    ArrayView<const Point<2>> polygon);
} // namespace plumbline::geometry
