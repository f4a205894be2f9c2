#include "geometry/ball_cell.h"

#include "base/error.h"
#include "geometry/ball_cell_exact.h"
#include "geometry/ball_cell_fan.h"
#include "geometry/ball_cell_moments.h"
#include "geometry/ball_cell_plane.h"
#include "geometry/ball_cell_polar.h"
#include "geometry/ball_cell_walk.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace plumbline::geometry
{
  namespace
  {
    using namespace detail;

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
    void examine(ArrayView<const Point<2>> vertices, double area, double diagonal_square)
    {
      if (std::abs(area) <= flat * diagonal_square)
        reject(vertices, "is degenerate, its area is zero; give corners that span an area");
      if (area < 0)
        reject(vertices, "is clockwise, area " + std::to_string(area) +
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

    [[noreturn]] void reject(const Ball &ball)
    {
      std::ostringstream message;
      message << "ball of radius " << ball.radius << " at (" << ball.centre[0] << ", "
              << ball.centre[1]
              << ") cannot be used; the radius must be a finite length > 0, the centre finite";
      throw InputError(message.str());
    }

    void check(const Ball &ball)
    {
      if (!(ball.radius > 0) || !std::isfinite(ball.radius + ball.centre[0] + ball.centre[1]))
        reject(ball);
    }

    Moments moments(const PolygonSum &sum, const Point<2> &origin, const Box &box)
    {
      const Vec c = vec(absolute(sum.centroid(), origin)), lower = vec(box.lower),
                upper = vec(box.upper);
      // a sliver of rounding's size may have its centroid anywhere: keep it in the cell
      return {sum.area(),
              Point<2>(std::clamp(c.x, lower.x, upper.x), std::clamp(c.y, lower.y, upper.y)),
              sum.second()};
    }

    // ---- where ball and cell meet ---------------------------------------------------------------

    /// Whether ball and cell are apart by more than rounding.
    bool is_apart(const Ball &ball, const Box &box)
    {
      const Vec below = relative(box.lower, ball.centre), above = relative(ball.centre, box.upper);
      const Vec d{std::max({below.x, above.x, 0.}), std::max({below.y, above.y, 0.})};
      return dot(d, d) > (1 + 8 * eps) * ball.radius * ball.radius;
    }

    /// Whether the ball covers the cell by more than rounding.
    bool is_covered(const Ball &ball, const ConvexCell &cell)
    {
      const double allowed = (1 - 8 * eps) * ball.radius * ball.radius;
      const auto is_inside = [&](const Point<2> &v)
      {
        const Vec x = relative(v, ball.centre);
        return dot(x, x) < allowed;
      };
      return std::all_of(cell.vertices().begin(), cell.vertices().end(), is_inside);
    }

    /// A small cell is described relative to its first vertex, any other relative to the ball's
    /// centre: the smaller of the two sets the size of the rounding.
    bool is_small(const ConvexCell &cell, const Ball &ball)
    {
      const Vec diagonal = relative(cell.box().upper, cell.box().lower);
      return dot(diagonal, diagonal) <= 3 * ball.radius * ball.radius;
    }

    const Point<2> &frame_origin(const Ball &ball, const ConvexCell &cell)
    {
      return is_small(cell, ball) ? cell.vertices()[0] : ball.centre;
    }

    /// Hands the boundary relative to the frame's origin to `sink`.
    template <class Sink>
    void find(const Ball &ball, const ConvexCell &cell, Backend backend, Sink &sink)
    {
      if (backend == Backend::cgal)
        for (const Piece &p : exact_boundary(ball, cell.vertices(), frame_origin(ball, cell)))
          if (p.is_arc)
            sink.arc(vec(p.from), vec(p.to), p.angle > pi);
          else
            sink.segment(vec(p.from), vec(p.to));
      else if (is_apart(ball, cell.box()))
        return;
      else if (is_small(cell, ball))
        walk(SmallCell(ball, cell.vertices()), sink);
      else
        walk(SmallBall(ball, cell.vertices()), sink);
    }

    Sides sides(const Ball &ball, const ConvexCell &cell, Backend backend)
    {
      check(ball);
      Sides result;
      find(ball, cell, backend, result);
      return result;
    }

    /// Whether a point lies to the right of a segment by more than rounding.
    bool is_beyond(const Side &side, Vec point)
    {
      const Vec a = side.from - point, e = side.to - side.from;
      const double rounding = 4 * eps * (std::sqrt(dot(a, a) * dot(e, e)) + dot(e, e));
      return !side.is_arc && cross(a, e) < -rounding;
    }
  } // namespace

  ConvexCell::ConvexCell(ArrayView<const Point<2>> vertices) : vertices_(vertices)
  {
    const unsigned int n = vertices.size();
    if (n < 3)
      reject(vertices, "has " + std::to_string(n) + " of them; give at least 3");
    box_ = {vertices[0], vertices[0]};
    PolygonSum sum;
    double finite = 0, least_turn = 0;
    unsigned int flips = 0; // of edges between the upper and the lower half plane: 2 if convex
    const auto is_upper = [](Vec e) { return e.y > 0 || (e.y == 0 && e.x > 0); };
    Vec a = vec(vertices[n - 1]), last{0, 0}; // the edge that ends in a
    for (unsigned int i = n - 1; i > 0 && same(last, {0, 0}); --i)
      last = relative(vertices[i], vertices[i - 1]);
    for (const Point<2> &vertex : vertices)
    {
      const Vec b = vec(vertex), e = b - a;
      for (int k = 0; k < 2; ++k)
      {
        finite += vertex[k] - vertex[k]; // NaN if a coordinate is NaN or infinite
        box_.lower[k] = std::min(box_.lower[k], vertex[k]);
        box_.upper[k] = std::max(box_.upper[k], vertex[k]);
      }
      sum.segment(a - vec(vertices[0]), b - vec(vertices[0]));
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
    const double diagonal_square = (box_.upper - box_.lower).norm_square();
    if (!(least_turn >= 0 && flips == 2 && sum.area() > flat * diagonal_square))
      examine(vertices, sum.area(), diagonal_square);
    moments_ = geometry::moments(sum, vertices[0], box_);
  }

  Moments intersect(const Ball &ball, const ConvexCell &cell, Backend backend)
  {
    check(ball);
    if (backend == Backend::fast && is_covered(ball, cell))
      return cell.moments();
    const Point<2> &origin = frame_origin(ball, cell);
    MomentSum sum(ball.radius, relative(ball.centre, origin));
    find(ball, cell, backend, sum);
    if (!(sum.area() > 0))
      return {0, cell.vertices()[0], {}};

    Moments result = moments(sum, origin, cell.box());
    result.area = std::min({result.area, cell.moments().area, pi * ball.radius * ball.radius});
    const Vec r = relative(result.centroid, ball.centre); // of slivers, likewise
    const double square = dot(r, r), allowed = ball.radius * (1 - 2 * eps);
    if (square > allowed * allowed)
      result.centroid = absolute((allowed / std::sqrt(square)) * r, ball.centre);
    return result;
  }

  std::vector<Piece> boundary(const Ball &ball, const ConvexCell &cell, Backend backend)
  {
    const Point<2> &origin = frame_origin(ball, cell);
    const Vec centre = relative(ball.centre, origin);
    std::vector<Piece> result;
    for (const Side &s : sides(ball, cell, backend))
    {
      const double angle = s.is_arc ? arc_angle(s.from - centre, s.to - centre, s.is_major) : 0;
      const Piece p{absolute(s.from, origin), absolute(s.to, origin), s.is_arc, angle};
      if (p.from != p.to || p.angle > pi)
        result.push_back(p);
    }
    return result;
  }

  void cut_rule(const Ball &ball, const ConvexCell &cell, unsigned int degree, CutRule &rule,
                Backend backend)
  {
    const Point<2> &origin = frame_origin(ball, cell);
    Fan fan(ball.radius, relative(ball.centre, origin), origin, degree, rule);
    fan.fill(sides(ball, cell, backend));
  }

  CutRule cut_rule(const Ball &ball, const ConvexCell &cell, unsigned int degree, Backend backend)
  {
    CutRule rule;
    cut_rule(ball, cell, degree, rule, backend);
    return rule;
  }

  void polar_rule(const Ball &ball, const ConvexCell &cell, unsigned int n_angles,
                  unsigned int n_radii, CutRule &rule, Backend backend)
  {
    if (n_angles == 0 || n_radii == 0)
      throw InputError("polar rule with " + std::to_string(n_angles) + " angles and " +
                       std::to_string(n_radii) + " radii; give at least 1 of each");
    const Vec centre = relative(ball.centre, frame_origin(ball, cell));
    const Sides all = sides(ball, cell, backend);
    rule.points.clear();
    rule.weights.clear();
    PolarRule polar(ball, centre, n_angles, n_radii, rule);
    if (std::any_of(all.begin(), all.end(), [&](const Side &s) { return is_beyond(s, centre); }))
      polar.add_band(all);
    else
      for (const Side &s : all)
        polar.add_from_centre(s);
  }

  CutRule polar_rule(const Ball &ball, const ConvexCell &cell, unsigned int n_angles,
                     unsigned int n_radii, Backend backend)
  {
    CutRule rule;
    polar_rule(ball, cell, n_angles, n_radii, rule, backend);
    return rule;
  }

  std::vector<double> weighted_moments(const Ball &ball, const ConvexCell &cell,
                                       const std::function<double(double)> &f, unsigned int degree,
                                       Backend backend)
  {
    const CutRule rule =
        polar_rule(ball, cell, std::max(16u, degree + 8), std::max(10u, degree / 2 + 6), backend);
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
