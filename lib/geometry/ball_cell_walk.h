#pragma once

#include "geometry/ball_cell_plane.h"

#include <algorithm>
#include <cmath>

/// The fast backend of ball ∩ convex polygon: walk the edges, split each at the circle. Private to
/// ball_cell.cc.
namespace plumbline::geometry::detail
{
  struct Vertex
  {
    Vec at;       ///< relative to the frame's origin
    double power; ///< |.|² - radius²; inside if <= 0
  };

  /// Positions relative to the first vertex, for a cell whose diagonal is below √3 radii: no arc in
  /// it is as long as a half circle. The first vertex's power is taken in twofold precision; from
  /// there on all roundings are relative to the cell, and a circle far larger than the cell costs
  /// no digits.
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

    /// An edge against the circle; the power along it is power + 2 p t + q t², t in [0, 1].
    struct Cut
    {
      Vec from, e;
      double power, p, q;
      double offset = 0; ///< not needed: no arc is longer than a half circle

      double discriminant() const { return p * p - q * power; }
      double root() const { return std::sqrt(std::max(discriminant(), 0.)); }
      Vec at(double t) const { return from + std::clamp(t, 0., 1.) * e; }

      /// Whether an edge with both ends outside enters the ball.
      bool crosses() const { return p < 0 && p + q > 0 && discriminant() > 0; }
      Vec entry() const { return at(p < 0 ? power / (root() - p) : 1); }
      Vec exit() const { return at(p > 0 ? -power / (p + root()) : (root() - p) / q); }
    };

    Cut cut(const Vertex &a, const Vertex &b, unsigned int) const
    {
      const Vec e = b.at - a.at;
      return {a.at, e, a.power, dot(from_centre + a.at, e), dot(e, e)};
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

    /// An edge against the circle, by lengths along it from the foot of the centre.
    struct Cut
    {
      Vec t;
      double from, to;
      double offset; ///< of the edge's line from the centre, > 0 if the centre is to its left
      double square; ///< of half the chord; crosses if > 0

      double half_chord() const { return std::sqrt(std::max(square, 0.)); }
      Vec at(double s) const
      {
        s = std::max(from, std::min(s, to));
        return {offset * t.y + s * t.x, -offset * t.x + s * t.y};
      }
      bool crosses() const { return square > 0; }
      Vec entry() const { return at(-half_chord()); }
      Vec exit() const { return at(half_chord()); }
    };

    Cut cut(const Vertex &a, const Vertex &b, unsigned int i) const
    {
      const Vec e = edge(i);
      if (a.power > 0 && b.power > 0 && !(dot(a.at, e) < 0 && dot(b.at, e) > 0))
        return {}; // an end is nearest to the centre
      const double scale = 1 / std::sqrt(dot(e, e)), d = scale * turn(i);
      const Vec t = scale * e;
      return {t, dot(a.at, t), dot(b.at, t), d, (ball.radius - d) * (ball.radius + d)};
    }

    /// How far the centre is to the left of an edge, times its length.
    double turn(unsigned int i) const
    {
      return edge_cross(vertices[i], vertices[(i + 1) % vertices.size()], ball.centre);
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

    /// Whether the polygon contains the ball, given that no edge meets it.
    bool contains_ball() const
    {
      for (unsigned int i = 0; i < vertices.size(); ++i)
        if (turn(i) < 0)
          return false;
      return true;
    }
  };

  /// Hands the boundary, piece by piece and counter-clockwise, to `sink`.
  template <class Frame, class Sink>
  void walk(const Frame &frame, Sink &sink)
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
        const auto cut = frame.cut(a, b, i);
        if (a_in || b_in || cut.crosses())
        {
          is_empty = false;
          const Vec from = a_in ? a.at : cut.entry(), to = b_in ? b.at : cut.exit();
          if (!a_in)
            enter({from, i, cut.offset});
          sink.segment(from, to);
          if (!b_in)
            last = {to, i, cut.offset}, has_last = true;
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
