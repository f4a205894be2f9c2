#pragma once

#include "geometry/ball_cell.h"

#include <boost/container/small_vector.hpp>

#include <cmath>
#include <limits>

/// Vectors, arithmetic and pieces of a boundary, private to ball_cell.cc.
namespace plumbline::geometry::detail
{
  constexpr double pi = 3.14159265358979323846;
  constexpr double eps = std::numeric_limits<double>::epsilon();

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

  // ---- the boundary of the region -------------------------------------------------------------

  /// A piece of the boundary relative to the frame's origin.
  struct Side
  {
    Vec from, to;
    bool is_arc, is_major;
  };

  /// Unit vector from the centre to the middle of an arc: square to its chord or, where that is too
  /// short to tell, opposite to it.
  inline Vec outward(const Side &arc, Vec centre)
  {
    const Vec e = arc.to - arc.from, m = arc.from + .5 * e - centre;
    const Vec n = arc.is_major && dot(e, e) < dot(m, m) ? -1 * m : Vec{e.y, -e.x};
    return (1 / std::sqrt(dot(n, n))) * n;
  }

  struct Sides : boost::container::small_vector<Side, 16> // allocates for large polygons alone
  {
    void segment(Vec p, Vec q)
    {
      if (!same(p, q))
        push_back({p, q, false, false});
    }
    void arc(Vec p, Vec q, bool is_major)
    {
      if (is_major || !same(p, q))
        push_back({p, q, true, is_major});
    }
  };
} // namespace plumbline::geometry::detail
