// CGAL's own checks cost ten times what it checks; they guard CGAL, not our input.
#ifndef CGAL_NDEBUG
#define CGAL_NDEBUG
#endif

#include "geometry/ball_cell_exact.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/General_polygon_set_2.h>
#include <CGAL/Gps_circle_segment_traits_2.h>

#include <boost/variant.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

namespace plumbline::geometry
{
  namespace
  {
    using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
    using Number = Kernel::FT;
    using Traits = CGAL::Gps_circle_segment_traits_2<Kernel>;
    using Set = CGAL::General_polygon_set_2<Traits>;
    using Curve = Traits::Curve_2;
    using Arc = Traits::X_monotone_curve_2;
    using Region = Traits::Polygon_2;

    /// a + b √c rounded to a double without cancellation: where the two terms oppose each other it
    /// is (a² - b² c) / (a - b √c), whose numerator is exact.
    double rounded(const Traits::Point_2::CoordNT &x)
    {
      if (!x.is_extended())
        return CGAL::to_double(x.a0().exact());
      const auto &a = x.a0().exact(), &b = x.a1().exact(), &c = x.root().exact();
      const double rational = CGAL::to_double(a);
      const double root = CGAL::to_double(b) * std::sqrt(CGAL::to_double(c));
      if (rational * root >= 0)
        return rational + root;
      const std::decay_t<decltype(a)> difference = a * a - b * b * c;
      return CGAL::to_double(difference) / (rational - root);
    }

    Point<2> rounded(const Traits::Point_2 &p)
    {
      return {rounded(p.x()), rounded(p.y())};
    }

    Region polygon(const std::vector<Kernel::Point_2> &corners)
    {
      Region region;
      for (std::size_t i = 0; i < corners.size(); ++i)
        region.push_back(Arc(corners[i], corners[(i + 1) % corners.size()]));
      return region;
    }

    Region disc(const Kernel::Point_2 &centre, const Number &radius)
    {
      const Curve circle(centre, radius, CGAL::COUNTERCLOCKWISE);
      std::vector<boost::variant<Traits::Point_2, Arc>> halves;
      Traits().make_x_monotone_2_object()(circle, std::back_inserter(halves));
      Region region;
      for (const auto &half : halves)
        region.push_back(boost::get<Arc>(half));
      return region;
    }

    /// Angle of an arc of at most a half circle, in [0, π]. The rounded ends of a tiny arc may have
    /// changed places, those of a half circle may span more than one.
    double half_angle_at_most(const Point<2> &from, const Point<2> &to, const Point<2> &centre)
    {
      const auto p = from - centre, q = to - centre;
      const double angle = std::atan2(p[0] * q[1] - p[1] * q[0], p[0] * q[0] + p[1] * q[1]);
      return angle < -1 ? -angle : std::max(angle, 0.);
    }
  } // namespace

  std::vector<Piece> exact_boundary(const Ball &ball, ArrayView<const Point<2>> vertices,
                                    const Point<2> &origin)
  {
    const auto shifted = [&](const Point<2> &p)
    { return Kernel::Point_2(Number(p[0]) - Number(origin[0]), Number(p[1]) - Number(origin[1])); };
    std::vector<Kernel::Point_2> corners;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      if (vertices[i] != vertices[(i + 1) % vertices.size()])
        corners.push_back(shifted(vertices[i]));
    const Kernel::Point_2 centre = shifted(ball.centre);

    Set set(polygon(corners));
    set.intersection(disc(centre, Number(ball.radius)));
    std::vector<Traits::Polygon_with_holes_2> regions; // one or none: both sets are convex
    set.polygons_with_holes(std::back_inserter(regions));
    if (regions.empty())
      return {};

    const Point<2> c(CGAL::to_double(centre.x().exact()), CGAL::to_double(centre.y().exact()));
    std::vector<Piece> pieces;
    const Region &region = regions[0].outer_boundary();
    for (auto side = region.curves_begin(); side != region.curves_end(); ++side)
    {
      Piece piece{rounded(side->source()), rounded(side->target()), side->is_circular(), 0};
      if (piece.from == piece.to)
        continue; // by rounding: no single one of these is a full circle
      if (piece.is_arc)
        piece.angle = half_angle_at_most(piece.from, piece.to, c);
      // CGAL ends arcs where their tangent is vertical; make one of neighbours
      if (piece.is_arc && !pieces.empty() && pieces.back().is_arc)
      {
        pieces.back().to = piece.to;
        pieces.back().angle += piece.angle;
      }
      else
        pieces.push_back(piece);
    }
    if (pieces.size() > 1 && pieces.front().is_arc && pieces.back().is_arc)
    {
      pieces.front().from = pieces.back().from;
      pieces.front().angle += pieces.back().angle;
      pieces.pop_back();
    }
    return pieces;
  }
} // namespace plumbline::geometry
