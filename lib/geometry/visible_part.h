#pragma once

#include "geometry/search.h"
#include "geometry/visibility.h"

namespace plumbline::geometry
{
  /// What cuts off a part of a ball about a point of a body.
  enum class FamilyCut
  {
    none,    ///< all of the ball is visible
    surface, ///< a free surface alone
    crack    ///< a crack, perhaps a free surface as well
  };

  /// How a bond meets the cracks.
  enum class Passage
  {
    clear,
    touches_end, ///< it passes through an end of a crack, to rounding, and crosses no other side
    crosses
  };

  /// A body in the plane with free surfaces and cracks. The visible part of the family of a point x
  /// is
  ///   {y in ball and body: the segment from x to y does not meet a crack},
  /// the integration domain of the operator there. Free surfaces themselves hide nothing: in a body
  /// that is not convex, a ball reaches across a gap unless its sides are given as cracks.
  class VisibleBody
  {
  public:
    /// @param parts      convex, counter-clockwise, without common area; their union is the body.
    /// Empty: the whole plane, which has no free surface
    /// @param cracks     two points or more each, none in the place of the next
    /// @param tolerance  bonds that pass the end of a crack as near as that touch it [length]
    VisibleBody(std::vector<Polygon> parts, const std::vector<Polyline> &cracks, double tolerance);

    /// @param visible  overwritten: convex polygons without common area, whose part in the ball is
    /// the visible part
    /// Accuracy: parts of less than 1e-9 of the ball's area are not told from nothing.
    FamilyCut find(const Ball &ball, std::vector<Polygon> &visible) const;

    /// Of a segment between two points that are on no crack. The same from both ends. A segment
    /// along a crack is clear.
    Passage passage(const Point<2> &p, const Point<2> &q) const;

    /// Whether the segment between two points of the body lies in the body, to 1e-9 of its length.
    bool holds(const Point<2> &p, const Point<2> &q) const;

    bool has_surfaces() const { return !parts_.empty(); }

  private:
    std::vector<Polygon> parts_;
    std::vector<Cut> cuts_;
    std::vector<Point<2>> ends_; ///< of open cracks, where no other crack goes on
    double tolerance_;
    BoxSearch<2> part_search_, cut_search_;
  };

  /// ∫ f(|z - x|) (z - x)^(a,b) over the ball about x and the union of convex polygons without
  /// common area, for a + b <= degree, in the order and with the accuracy of weighted_moments.
  std::vector<double> weighted_moments(const Ball &ball, const std::vector<Polygon> &polygons,
                                       const std::function<double(double)> &f, unsigned int degree);

  /// A union of boxes minus other boxes as rectangles without common area.
  std::vector<Polygon> convex_parts(const Domain &domain);
} // namespace plumbline::geometry
