#pragma once

#include "geometry/ball_cell.h"

#include <algorithm>
#include <cmath>

/// The fast backend of ball ∩ convex polygon, private to ball_cell.cc.
namespace plumbline::geometry::detail
{
  constexpr double pi = 3.14159265358979323846;

  struct Vec
  {
    double x, y;
  };

  inline Vec operator+(Vec a, Vec b)
  {
    return {a.x + b.x, a.y + b.y};
  }
  inline Vec operator-(Vec a, Vec b)
  {
    return {a.x - b.x, a.y - b.y};
  }
  inline Vec operator*(double s, Vec a)
  {
    return {s * a.x, s * a.y};
  }
  inline double dot(Vec a, Vec b)
  {
    return a.x * b.x + a.y * b.y;
  }
  inline double cross(Vec a, Vec b)
  {
    return a.x * b.y - a.y * b.x;
  }
  inline bool same(Vec a, Vec b)
  {
    return a.x == b.x && a.y == b.y;
  }
  inline Vec vec(const Point<2> &p)
  {
    return {p[0], p[1]};
  }
  inline Vec relative(const Point<2> &p, const Point<2> &origin)
  {
    return {p[0] - origin[0], p[1] - origin[1]};
  }
  inline Point<2> absolute(Vec a, const Point<2> &origin)
  {
    return Point<2>(origin[0] + a.x, origin[1] + a.y);
  }

  // ---- twice the working precision, where a difference of large numbers decides ---------------

  /// hi + lo, |lo| <= eps |hi| / 2.
  struct Twofold
  {
    double hi, lo;
  };

  inline Twofold difference(double a, double b)
  {
    const double s = a - b, t = s - a;
    return {s, (a - (s - t)) - (b + t)};
  }

  inline Twofold product(double a, double b) // Dekker
  {
    constexpr double split = 134217729; // 2^27 + 1
    const double p = a * b, ca = split * a, cb = split * b;
    const double ah = ca - (ca - a), al = a - ah, bh = cb - (cb - b), bl = b - bh;
    return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
  }

  /// |p - centre|² - radius², to about eps² radius² + eps |result|.
  inline double power(const Point<2> &p, const Ball &ball)
  {
    const Twofold x = difference(p[0], ball.centre[0]), y = difference(p[1], ball.centre[1]);
    const Twofold xx = product(x.hi, x.hi), yy = product(y.hi, y.hi);
    const Twofold rr = product(ball.radius, ball.radius);
    const Twofold s = difference(xx.hi, rr.hi), t = difference(s.hi, -yy.hi);
    return t.hi + (t.lo + s.lo + xx.lo + yy.lo - rr.lo + 2 * (x.hi * x.lo + y.hi * y.lo));
  }

  /// (a - centre) × (b - a), likewise.
  inline double edge_cross(const Point<2> &a, const Point<2> &b, const Point<2> &centre)
  {
    const Twofold x = difference(a[0], centre[0]), y = difference(a[1], centre[1]);
    const Twofold u = difference(b[0], a[0]), v = difference(b[1], a[1]);
    const Twofold xv = product(x.hi, v.hi), yu = product(y.hi, u.hi);
    return (xv.hi - yu.hi) +
           (xv.lo - yu.lo + (x.hi * v.lo + x.lo * v.hi) - (y.hi * u.lo + y.lo * u.hi));
  }

  // ---- the fast backend: walk the edges, split each at the circle -----------------------------

  struct Vertex
  {
    Vec at;       ///< relative to the frame's origin
    double power; ///< |.|² - radius²; inside if <= 0
  };

  struct Cut
  {
    bool crosses; ///< whether an edge with both ends outside enters the ball
    Vec entry, exit;
    double offset; ///< of the edge's line from the centre, > 0 if the centre is to its left
  };

  /// Positions relative to the first vertex, for a cell whose diagonal is below the radius. The
  /// first vertex's power is taken in twofold precision; from there on all roundings are relative
  /// to the cell, and a circle far larger than the cell costs no digits.
  struct SmallCell
  {
    const Ball &ball;
    const ArrayView<const Point<2>> vertices;
    const Vec from_centre;
    const double power_0;

    SmallCell(const Ball &b, ArrayView<const Point<2>> v)
        : ball(b), vertices(v), from_centre(relative(v[0], b.centre)), power_0(power(v[0], b))
    {
    }

    Vertex vertex(unsigned int i) const
    {
      const Vec x = relative(vertices[i], vertices[0]);
      return {x, power_0 + (2 * dot(from_centre, x) + dot(x, x))};
    }

    Cut cut(const Vertex &a, const Vertex &b, unsigned int)
    {
      // power along the edge: a.power + 2 p t + q t², t in [0, 1]
      const Vec e = b.at - a.at;
      const double q = dot(e, e), p = dot(from_centre + a.at, e);
      const double discriminant = p * p - q * a.power;
      const double root = std::sqrt(std::max(discriminant, 0.));
      const double entry = p < 0 ? a.power / (root - p) : 1;
      const double exit = p > 0 ? -a.power / (p + root) : (root - p) / q;
      const auto at = [&](double t) { return a.at + std::clamp(t, 0., 1.) * e; };
      return {discriminant > 0 && p < 0 && p + q > 0, at(entry), at(exit), 0};
    }

    bool is_major(Vec, unsigned int, double, Vec, unsigned int, double) const { return false; }
    bool contains_ball() const { return false; }
  };

  /// Positions relative to the centre, for all other cells: what counts is the edges' distance from
  /// the centre, taken in twofold precision, so that an edge far longer than the radius costs none.
  struct SmallBall
  {
    const Ball &ball;
    const ArrayView<const Point<2>> vertices;
    bool centre_is_inside = true;

    SmallBall(const Ball &b, ArrayView<const Point<2>> v) : ball(b), vertices(v) {}

    Vertex vertex(unsigned int i) const
    {
      const Vec x = relative(vertices[i], ball.centre);
      return {x, dot(x, x) - ball.radius * ball.radius};
    }

    Vec edge(unsigned int i) const
    {
      return relative(vertices[(i + 1) % vertices.size()], vertices[i % vertices.size()]);
    }

    Cut cut(const Vertex &a, const Vertex &b, unsigned int i)
    {
      const Vec e = edge(i);
      const double length = std::sqrt(dot(e, e));
      const Vec t = (1 / length) * e;
      const double d =
          edge_cross(vertices[i], vertices[(i + 1) % vertices.size()], ball.centre) / length;
      const double from = dot(a.at, t), to = dot(b.at, t);
      const double square = (ball.radius - d) * (ball.radius + d);
      const double half_chord = std::sqrt(std::max(square, 0.));
      centre_is_inside = centre_is_inside && d > 0;
      const auto at = [&](double s)
      {
        s = std::max(from, std::min(s, to));
        return Vec{d * t.y + s * t.x, -d * t.x + s * t.y};
      };
      return {square > 0 && from < 0 && to > 0, at(-half_chord), at(half_chord), d};
    }

    /// Whether the arc from q (on edge i) to p (on edge j) is longer than a half circle.
    bool is_major(Vec q, unsigned int i, double offset_i, Vec p, unsigned int j,
                  double offset_j) const
    {
      constexpr double near = 1e-3; // of the radius: above, the cross product's sign is safe
      if (dot(p - q, p - q) > near * near * ball.radius * ball.radius)
        return cross(q, p) < 0;
      // the arc is nearly empty or nearly the circle; in the latter case the edges left out turn
      // by nearly 2π, and the centre lies inside of them
      bool turns_back = i == j;
      for (unsigned int k = i + 1; k % vertices.size() != j && !turns_back; ++k)
        turns_back = dot(edge(k), edge(i)) < 0;
      return turns_back && offset_i + offset_j > 0;
    }

    bool contains_ball() const { return centre_is_inside; }
  };

  /// Hands the boundary, piece by piece and counter-clockwise, to `sink`.
  template <class Frame, class Sink>
  void walk(Frame frame, Sink &sink)
  {
    struct Crossing
    {
      Vec at;
      unsigned int edge;
      double offset;
    };
    Crossing first{}, last{};
    bool has_first = false, has_last = false, is_empty = true;
    const auto arc = [&](const Crossing &q, const Crossing &p)
    { sink.arc(q.at, p.at, frame.is_major(q.at, q.edge, q.offset, p.at, p.edge, p.offset)); };
    const auto enter = [&](const Crossing &p)
    {
      if (has_last)
        arc(last, p);
      else
        first = p, has_first = true;
    };

    const unsigned int n = frame.vertices.size();
    const Vertex start = frame.vertex(0);
    Vertex a = start;
    for (unsigned int i = 0; i < n; ++i)
    {
      const Vertex b = i + 1 == n ? start : frame.vertex(i + 1);
      const bool a_in = a.power <= 0, b_in = b.power <= 0;
      if (a_in && b_in)
        sink.segment(a.at, b.at), is_empty = false;
      else if (!same(a.at, b.at))
      {
        const Cut cut = frame.cut(a, b, i);
        if (a_in || b_in || cut.crosses)
        {
          is_empty = false;
          if (!a_in)
            enter({cut.entry, i, cut.offset});
          sink.segment(a_in ? a.at : cut.entry, b_in ? b.at : cut.exit);
          if (!b_in)
            last = {cut.exit, i, cut.offset}, has_last = true;
        }
      }
      a = b;
    }
    if (has_first)
      arc(last, first);
    if (is_empty && frame.contains_ball())
      sink.arc({frame.ball.radius, 0}, {frame.ball.radius, 0}, true);
  }
} // namespace plumbline::geometry::detail
