#pragma once

#include "geometry/ball_cell_plane.h"

#include <algorithm>
#include <array>
#include <cmath>

/// Moments from the pieces of a boundary, private to ball_cell.cc.
namespace plumbline::geometry::detail
{
  /// Angle of the counter-clockwise arc from p to q, both relative to the centre, in [0, 2π].
  inline double arc_angle(Vec p, Vec q, bool is_major)
  {
    const double angle = std::atan2(cross(p, q), dot(p, q));
    const double least = is_major ? 1 : -1; // below only by rounding at 0, or beyond π
    return angle < least ? angle + 2 * pi : std::max(angle, 0.);
  }

  /// Area of a circular segment and its moments about the chord's middle: first moment n N, second
  /// moments nn N⊗N + tt T⊗T, with N an outward normal of the chord and T square to it, as long.
  struct Segment
  {
    double area, n, nn, tt;
  };

  /// N of length 1, sine and cosine x, y of half the angle.
  inline Segment large_segment(double radius, double x, double y)
  {
    const double RR = radius * radius, area = std::atan2(x, y) - x * y, cube = x * x * x;
    return {RR * area, RR * radius * (2. / 3 * cube - y * area),
            RR * RR * (area * (.25 + y * y) - 5. / 6 * cube * y),
            RR * RR * (area / 4 - cube * y / 6)};
  }

  /// The same for k = (1 - y) / 2 <= 1/36, free of differences of large numbers: with T a power
  /// series in k the area is R² x³ (2/3 + k T).
  class SmallSegment
  {
  public:
    static constexpr double largest = 1. / 36; // its 12th power is below rounding

    constexpr SmallSegment()
    {
      double s = 2. / 3;
      for (int j = 0; j < 12; ++j)
        coefficient_[j] = s *= (2 * j + 6) / (2. * j + 5);
    }

    /// N as long as the chord.
    Segment operator()(double radius, double x, double k) const
    {
      const double *c = coefficient_, kk = k * k, k4 = kk * kk;
      double part[4]; // every fourth power: a quarter of the wait
      for (int j = 0; j < 4; ++j)
        part[j] = (c[8 + j] * k4 + c[4 + j]) * k4 + c[j];
      const double T = (part[0] + k * part[1]) + kk * (part[2] + k * part[3]);
      const double s = radius * radius * x, kT = k * T;
      return {s * x * x * (2. / 3 + kT), .5 * s * x * k * (4. / 3 - T + 2 * kT),
              .25 * s * k * (1.25 * T - 1 + k * (8. / 3 - 4 * T + 4 * kT)),
              .25 * s * k * (1. / 3 + .25 * T)};
    }

  private:
    double coefficient_[12]{};
  };
  inline constexpr SmallSegment small_segment;

  /// Green's theorem on a polygon's edges, relative to the first corner.
  class PolygonSum
  {
  public:
    void segment(Vec p, Vec q)
    {
      if (!has_origin_) // seen from there, the first one spans no area
      {
        origin_ = p;
        has_origin_ = true;
        return;
      }
      p = p - origin_, q = q - origin_;
      const Vec s = p + q;
      const double w = cross(p, q);
      area_ += w / 2;
      first_ = first_ + (w * (1. / 6)) * s;
      second_[0] += w * (1. / 12) * (s.x * s.x - p.x * q.x);
      second_[1] += w * (1. / 24) * (s.x * s.y + p.x * p.y + q.x * q.y);
      second_[2] += w * (1. / 12) * (s.y * s.y - p.y * q.y);
    }

    /// Of the pieces handed over so far, about the centroid; the latter two need area > 0.
    double area() const { return area_; }
    Vec centroid() const { return origin_ + (1 / area_) * first_; }
    std::array<double, 3> second() const
    {
      const Vec g = (1 / area_) * first_;
      return {std::max(second_[0] - area_ * g.x * g.x, 0.), second_[1] - area_ * g.x * g.y,
              std::max(second_[2] - area_ * g.y * g.y, 0.)};
    }

  protected:
    bool has_origin_ = false;
    Vec origin_{};
    double area_ = 0;
    Vec first_{};
    std::array<double, 3> second_{};
  };

  /// The same with arcs: each is its chord and a circular segment, so that nothing is ever taken
  /// from the whole disc.
  class MomentSum : public PolygonSum
  {
  public:
    MomentSum(double radius, Vec centre) : radius_(radius), centre_(centre) {}

    void arc(Vec p, Vec q, bool is_major)
    {
      segment(p, q);
      const Vec e = q - p, middle = p + .5 * e;
      const double xx = dot(e, e) * (1 / (4 * radius_ * radius_)), x = std::sqrt(xx);
      const double root = std::sqrt(std::max(0., 1 - xx)), k = .5 * xx / (1 + root);
      if (k < small_segment.largest && !is_major)
      {
        add(small_segment(radius_, x, k), {e.y, -e.x}, middle - origin_);
        return;
      }
      const Vec n = outward({p, q, true, is_major}, centre_);
      const double y = root < .4 ? dot(n, middle - centre_) / radius_ : // it has lost digits
                           is_major ? -root
                                    : root;
      add(large_segment(radius_, x, y), n, middle - origin_);
    }

  private:
    void add(const Segment &s, Vec n, Vec middle)
    {
      const Vec f = s.n * n, g = s.area * middle + f;
      area_ += s.area;
      first_ = first_ + g;
      second_[0] += middle.x * (g.x + f.x) + s.nn * n.x * n.x + s.tt * n.y * n.y;
      second_[1] += middle.x * g.y + middle.y * f.x + (s.nn - s.tt) * n.x * n.y;
      second_[2] += middle.y * (g.y + f.y) + s.nn * n.y * n.y + s.tt * n.x * n.x;
    }

    const double radius_;
    const Vec centre_;
  };
} // namespace plumbline::geometry::detail
