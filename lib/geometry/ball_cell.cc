#include "geometry/ball_cell.h"

#include "base/error.h"
#include "geometry/ball_cell_exact.h"
#include "geometry/ball_cell_moments.h"
#include "geometry/ball_cell_polar.h"
#include "geometry/ball_cell_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

namespace plumbline::geometry
{
  namespace
  {
    using namespace detail;

    constexpr double eps = std::numeric_limits<double>::epsilon();

    // ---- what is allowed ------------------------------------------------------------------------

    /// What every algorithm below needs to know about a polygon.
    struct Shape
    {
      double area;
      Vec lower, upper; ///< bounding box
      double diagonal_square() const { return dot(upper - lower, upper - lower); }
    };

    /// A polygon whose area is below this fraction of its bounding box's diagonal squared is
    /// degenerate: its area is then rounding.
    constexpr double flat = 8 * eps;

    [[noreturn]] void reject(ArrayView<const Point<2>> vertices, const std::string &why)
    {
      std::ostringstream message;
      message.precision(17);
      message << "cell with vertices";
      for (const auto &v : vertices)
        message << " (" << v[0] << ", " << v[1] << ")";
      message << " " << why;
      throw InputError(message.str());
    }

    /// Why a polygon that failed the quick test is no convex one; returns if only rounding is to
    /// blame, as with corners on a straight side that are off it by the rounding of their
    /// coordinates.
    void examine(ArrayView<const Point<2>> vertices, const Shape &shape)
    {
      if (std::abs(shape.area) <= flat * shape.diagonal_square())
        reject(vertices, "is degenerate, its area is zero; give corners that span an area");
      if (shape.area < 0)
        reject(vertices, "is clockwise, area " + std::to_string(shape.area) +
                             "; reverse the order of the vertices");
      const unsigned int n = vertices.size();
      std::vector<Vec> edges;
      for (unsigned int i = 0; i < n; ++i)
        if (vertices[i] != vertices[(i + 1) % n])
          edges.push_back(relative(vertices[(i + 1) % n], vertices[i]));
      double largest = 0, turned = 0;
      for (const auto &v : vertices)
        largest = std::max({largest, std::abs(v[0]), std::abs(v[1])});
      bool convex = true;
      for (std::size_t i = 0; i < edges.size(); ++i)
      {
        const Vec a = edges[i], b = edges[(i + 1) % edges.size()];
        const double slack = 8 * eps * largest * (std::sqrt(dot(a, a)) + std::sqrt(dot(b, b)));
        convex = convex && cross(a, b) >= -slack && (cross(a, b) > slack || dot(a, b) > 0);
        turned += std::atan2(cross(a, b), dot(a, b));
      }
      if (!convex || std::abs(turned - 2 * pi) > 1)
        reject(vertices, "is not convex; split it into convex cells");
    }

    Shape check(const Ball &ball, ArrayView<const Point<2>> vertices)
    {
      const unsigned int n = vertices.size();
      if (!(ball.radius > 0) || !std::isfinite(ball.radius + ball.centre[0] + ball.centre[1]))
      {
        std::ostringstream message;
        message << "ball of radius " << ball.radius << " at (" << ball.centre[0] << ", "
                << ball.centre[1]
                << ") cannot be used; the radius must be a finite length > 0, the centre finite";
        throw InputError(message.str());
      }
      if (n < 3)
        reject(vertices, "has " + std::to_string(n) + " of them; give at least 3");

      Shape shape{0, vec(vertices[0]), vec(vertices[0])};
      double finite = 0, least_turn = 0;
      unsigned int flips = 0; // of edges between the upper and the lower half plane: 2 if convex
      const auto is_upper = [](Vec e) { return e.y > 0 || (e.y == 0 && e.x > 0); };
      Vec a = vec(vertices[n - 1]), last{0, 0}; // the edge that ends in a
      for (unsigned int i = n - 1; i > 0 && same(last, {0, 0}); --i)
        last = relative(vertices[i], vertices[i - 1]);
      for (unsigned int i = 0; i < n; ++i)
      {
        const Vec b = vec(vertices[i]), e = b - a;
        finite += (b.x - b.x) + (b.y - b.y); // NaN if a coordinate is NaN or infinite
        shape.lower = {std::min(shape.lower.x, b.x), std::min(shape.lower.y, b.y)};
        shape.upper = {std::max(shape.upper.x, b.x), std::max(shape.upper.y, b.y)};
        shape.area += .5 * cross(a - vec(vertices[0]), e);
        if (!same(e, {0, 0}))
        {
          least_turn = std::min(least_turn, cross(last, e));
          flips += is_upper(last) != is_upper(e);
          last = e;
        }
        a = b;
      }
      if (finite != 0)
        reject(vertices, "has a coordinate that is not finite; give finite coordinates");
      if (!(least_turn >= 0 && flips == 2 && shape.area > flat * shape.diagonal_square()))
        examine(vertices, shape);
      return shape;
    }

    /// A cell whose diagonal is below the radius is described relative to its first vertex, any
    /// other relative to the ball's centre: the smaller of the two sets the size of the rounding.
    bool is_small_cell(const Ball &ball, const Shape &shape)
    {
      return shape.diagonal_square() <= ball.radius * ball.radius;
    }

    const Point<2> &frame_origin(const Ball &ball, ArrayView<const Point<2>> vertices,
                                 const Shape &shape)
    {
      return is_small_cell(ball, shape) ? vertices[0] : ball.centre;
    }

    /// Keeps the pieces.
    struct Pieces
    {
      Vec centre;
      std::vector<Piece> pieces;

      void segment(Vec p, Vec q)
      {
        if (!same(p, q))
          pieces.push_back({absolute(p, {}), absolute(q, {}), false, 0});
      }
      void arc(Vec p, Vec q, bool is_major)
      {
        if (is_major || !same(p, q))
          pieces.push_back({absolute(p, {}), absolute(q, {}), true,
                            arc_angle(p - centre, q - centre, is_major)});
      }
    };

    /// Hands the boundary relative to the frame's origin to `sink`.
    template <class Sink>
    void find(const Ball &ball, ArrayView<const Point<2>> vertices, const Shape &shape,
              Backend backend, Sink &sink)
    {
      if (backend == Backend::cgal)
        for (const Piece &p : exact_boundary(ball, vertices, frame_origin(ball, vertices, shape)))
          if (p.is_arc)
            sink.arc(vec(p.from), vec(p.to), p.angle > pi);
          else
            sink.segment(vec(p.from), vec(p.to));
      else if (is_small_cell(ball, shape))
        walk(SmallCell(ball, vertices), sink);
      else
        walk(SmallBall(ball, vertices), sink);
    }

    std::vector<Piece> pieces(const Ball &ball, ArrayView<const Point<2>> vertices,
                              const Shape &shape, Backend backend)
    {
      Pieces sink{relative(ball.centre, frame_origin(ball, vertices, shape)), {}};
      find(ball, vertices, shape, backend, sink);
      return sink.pieces;
    }

    /// Whether a point lies to the right of a segment by more than rounding.
    bool is_beyond(const Piece &side, Vec point)
    {
      const Vec a = vec(side.from) - point, e = vec(side.to) - vec(side.from);
      const double rounding = 4 * eps * (std::sqrt(dot(a, a) * dot(e, e)) + dot(e, e));
      return !side.is_arc && cross(a, e) < -rounding;
    }
  } // namespace

  Moments intersect(const Ball &ball, ArrayView<const Point<2>> vertices, Backend backend)
  {
    const Shape shape = check(ball, vertices);
    const Point<2> &origin = frame_origin(ball, vertices, shape);
    MomentSum sum(ball.radius, relative(ball.centre, origin));
    find(ball, vertices, shape, backend, sum);

    Moments result;
    result.centroid = vertices[0];
    if (!(sum.area() > 0))
      return result;
    result.area = std::min({sum.area(), shape.area, pi * ball.radius * ball.radius});
    result.second = sum.second();
    // a sliver of rounding's size may have its centroid anywhere: keep it in the cell and the ball
    Vec c = vec(absolute(sum.centroid(), origin));
    c = {std::clamp(c.x, shape.lower.x, shape.upper.x),
         std::clamp(c.y, shape.lower.y, shape.upper.y)};
    const Vec r = c - vec(ball.centre);
    const double square = dot(r, r), allowed = ball.radius * (1 - 2 * eps);
    if (square > allowed * allowed)
      c = vec(ball.centre) + (allowed / std::sqrt(square)) * r;
    result.centroid = Point<2>(c.x, c.y);
    return result;
  }

  std::vector<Piece> boundary(const Ball &ball, ArrayView<const Point<2>> vertices, Backend backend)
  {
    const Shape shape = check(ball, vertices);
    const Point<2> &origin = frame_origin(ball, vertices, shape);
    std::vector<Piece> result;
    for (Piece &p : pieces(ball, vertices, shape, backend))
    {
      p.from += origin;
      p.to += origin;
      if (p.from != p.to || p.angle > pi)
        result.push_back(p);
    }
    return result;
  }

  CutRule polar_rule(const Ball &ball, ArrayView<const Point<2>> vertices, unsigned int n_angles,
                     unsigned int n_radii, Backend backend)
  {
    if (n_angles == 0 || n_radii == 0)
      throw InputError("polar rule with " + std::to_string(n_angles) + " angles and " +
                       std::to_string(n_radii) + " radii; give at least 1 of each");
    const Shape shape = check(ball, vertices);
    const Vec centre = relative(ball.centre, frame_origin(ball, vertices, shape));
    const std::vector<Piece> sides = pieces(ball, vertices, shape, backend);
    const bool is_outside = std::any_of(sides.begin(), sides.end(),
                                        [&](const Piece &side) { return is_beyond(side, centre); });
    PolarRule polar(ball, centre, n_angles, n_radii);
    if (is_outside)
      polar.add_band(sides);
    else
      for (const Piece &p : sides)
        polar.add_from_centre(p);
    return std::move(polar.rule);
  }

  std::vector<double> weighted_moments(const Ball &ball, ArrayView<const Point<2>> vertices,
                                       const std::function<double(double)> &f, unsigned int degree,
                                       Backend backend)
  {
    const CutRule rule = polar_rule(ball, vertices, std::max(16u, degree + 8),
                                    std::max(10u, degree / 2 + 6), backend);
    std::vector<double> result((degree + 1) * (degree + 2) / 2, 0.);
    for (std::size_t q = 0; q < rule.points.size(); ++q)
    {
      const Vec z = relative(rule.points[q], ball.centre);
      const double value = rule.weights[q] * f(std::sqrt(dot(z, z)));
      std::size_t i = 0;
      for (unsigned int total = 0; total <= degree; ++total)
        for (unsigned int b = 0; b <= total; ++b)
          result[i++] += value * std::pow(z.x, total - b) * std::pow(z.y, b);
    }
    return result;
  }

  std::array<Point<2>, 4> square(const Point<2> &lower, double h)
  {
    const double x = lower[0] + h, y = lower[1] + h;
    return {{lower, Point<2>(x, lower[1]), Point<2>(x, y), Point<2>(lower[0], y)}};
  }
} // namespace plumbline::geometry
