#pragma once

#include "geometry/lattice.h"

#include <deal.II/base/array_view.h>
#include <deal.II/base/point.h>

#include <array>
#include <functional>
#include <vector>

namespace plumbline::geometry
{
  using dealii::ArrayView;
  using dealii::Point;

  struct Ball
  {
    Point<2> centre;   ///< [length]
    double radius = 0; ///< > 0 [length]
  };

  /// Who decides where the circle meets the polygon.
  enum class Backend
  {
    fast, ///< double precision, stable roots
    cgal  ///< CGAL's exact circular kernel: exact predicates and constructions, rounded at the end
  };

  /// Area, centroid and second moments of ball ∩ polygon.
  struct Moments
  {
    double area = 0;   ///< in [0, min(|ball|, |polygon|)] [length^2]
    Point<2> centroid; ///< in ball and cell up to its own rounding; the first vertex if area = 0
    std::array<double, 3> second{}; ///< ∫ xx, xy, yy about the centroid [length^4]
  };

  /// A convex polygon, checked and measured once, for the many balls it may meet. A view: the
  /// vertices must outlive it. Functions that take a cell also take its vertices.
  class ConvexCell
  {
  public:
    /// @param vertices  counter-clockwise, shape (n_vertices, 2) [length]; any number of them,
    /// repeated and collinear ones are allowed
    /// @throws InputError  fewer than 3 vertices, a vertex that is not finite, a polygon that is
    /// clockwise, degenerate or not convex
    ConvexCell(ArrayView<const Point<2>> vertices);
    ConvexCell(const std::vector<Point<2>> &vertices)
        : ConvexCell(ArrayView<const Point<2>>(vertices))
    {
    }

    ArrayView<const Point<2>> vertices() const { return vertices_; }
    const Box &box() const { return box_; }             ///< around it
    const Moments &moments() const { return moments_; } ///< of the whole cell

  private:
    ArrayView<const Point<2>> vertices_;
    Box box_;
    Moments moments_;
  };

  /// Area, centroid and second moments of ball ∩ cell.
  /// @throws InputError  radius <= 0 or not finite
  /// Accuracy: area to 1e-13 of min(|ball|, |polygon|), first and second moments likewise (in the
  /// shorter of the two diameters), for every position, tangency and corners on the circle
  /// included. A polygon of aspect ratio a costs digits in proportion; the centroid is rounded to
  /// its own coordinates.
  /// Backend::fast allocates nothing and takes .11 µs where a triangle or a square is cut, .01 µs
  /// where it is covered or apart, and .04 µs more for vertices to check; Backend::cgal takes 60
  /// µs. Not for: curved or non-convex cells; lengths below 1e-75 or above 1e75, whose powers leave
  /// double.
  /// Source: areas of the cells of a family as in Seleson 2014, doi:10.1016/j.cma.2014.06.016; here
  /// by Green's theorem on the boundary's pieces, an arc being its chord and a circular segment.
  Moments intersect(const Ball &ball, const ConvexCell &cell, Backend backend = Backend::fast);

  /// One side of the boundary of ball ∩ polygon: a segment, or an arc of the circle run
  /// counter-clockwise. A full circle is one arc with from = to.
  struct Piece
  {
    Point<2> from, to; ///< [length]
    bool is_arc = false;
    double angle = 0; ///< run by the arc, in (0, 2π], 0 for a segment [rad]
  };

  /// The boundary of ball ∩ cell, counter-clockwise; empty if the intersection is. Pieces
  /// of length zero are left out. Errors as `intersect`.
  /// Accuracy: end points to the rounding of their coordinates and, along the side, to that over
  /// the sine of the angle between side and circle.
  std::vector<Piece> boundary(const Ball &ball, const ConvexCell &cell,
                              Backend backend = Backend::fast);

  /// A quadrature rule on a planar region.
  struct CutRule
  {
    std::vector<Point<2>> points; ///< [length]
    std::vector<double> weights;  ///< [length^2]
  };

  /// Quadrature on ball ∩ cell, exact for polynomials of a degree on the curved region: triangles,
  /// and strips that lines sweep between an arc and a side or corner across of it, with Gauss's
  /// points on the lines and Gauss's rules for trigonometric polynomials in the arc's angle.
  /// Positive weights, points inside; empty if the intersection is.
  /// @throws InputError  as `intersect`
  /// Accuracy: 1e-13 of min(|ball|, |polygon|) times the largest |f|, for every position; points
  /// are rounded to their coordinates.
  /// Cost for degree 2, 4, 8 where a triangle is cut: 9, 20, 53 points and .26, .31, .43 µs; a
  /// triangle that is covered takes 3, 6, 16 points.
  /// Source: for the arcs Da Fies and Vianello 2012, Trigonometric Gaussian quadrature on
  /// subintervals of the period, ETNA 39; for the triangles Witherden and Vincent 2015,
  /// doi:10.1016/j.camwa.2015.03.017.
  CutRule cut_rule(const Ball &ball, const ConvexCell &cell, unsigned int degree,
                   Backend backend = Backend::fast);

  /// The same into a rule whose memory is used again.
  void cut_rule(const Ball &ball, const ConvexCell &cell, unsigned int degree, CutRule &rule,
                Backend backend = Backend::fast);

  /// Quadrature on ball ∩ cell in polar coordinates about the ball's centre: Gauss rules
  /// in the angle between the angles of corners and crossings (halved where a side is seen
  /// edge-on), and in the radius between entry and exit. The centre may lie inside the polygon, on
  /// its boundary or outside.
  /// Exact to round-off for smooth functions times a function of the distance to the centre that is
  /// smooth away from the centre or behaves like 1/r there. The weights contain the factor r; they
  /// are positive, and no point is the centre.
  /// @param n_angles  per interval, >= 1
  /// @param n_radii   per ray, >= 1
  /// @throws InputError  as `intersect`, and if n_angles or n_radii is 0
  /// Accuracy: the weights add up to the area to 1e-13 of min(|ball|, |polygon|). 16 angles and 10
  /// radii integrate polynomials of degree <= 8 times 1, 1 - r/R or 1/r to 1e-13 of the same times
  /// the largest |f|. Points are rounded to their coordinates, which a centre far from the origin
  /// makes felt.
  /// Cost: 5 µs and 460 points for a square in a larger ball, 10 µs and 900 near the centre.
  CutRule polar_rule(const Ball &ball, const ConvexCell &cell, unsigned int n_angles = 16,
                     unsigned int n_radii = 10, Backend backend = Backend::fast);

  /// The same into a rule whose memory is used again.
  void polar_rule(const Ball &ball, const ConvexCell &cell, unsigned int n_angles,
                  unsigned int n_radii, CutRule &rule, Backend backend = Backend::fast);

  /// ∫ f(|z - centre|) (z - centre)^(a,b) over ball ∩ cell for a + b <= degree, ordered (0,0),
  /// (1,0), (0,1), (2,0), (1,1), (0,2), ... [length^(2+a+b) times the unit of f]
  /// @param f  smooth for 0 < r <= R, at most like 1/r at 0; called with r > 0 [length]
  /// @throws InputError  as `intersect`
  /// Accuracy: as `polar_rule`, whose angles and radii grow with the degree from 16 and 10.
  std::vector<double> weighted_moments(const Ball &ball, const ConvexCell &cell,
                                       const std::function<double(double)> &f, unsigned int degree,
                                       Backend backend = Backend::fast);

  /// The four vertices of the square [x, x+h] × [y, y+h], counter-clockwise.
  std::array<Point<2>, 4> square(const Point<2> &lower, double h);

  /// The vertices as the functions above take them.
  inline ArrayView<const Point<2>> view(const std::array<Point<2>, 4> &vertices)
  {
    return {vertices.data(), vertices.size()};
  }
} // namespace plumbline::geometry
