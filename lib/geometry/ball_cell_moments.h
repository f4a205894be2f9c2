#pragma once

#include "geometry/ball_cell_walk.h"

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

  /// Area and moments of the circular segment of the unit circle with half angle α, x = sin α, in
  /// the frame (t, n) with t along the chord, n outwards and the chord's middle as origin.
  struct Segment
  {
    double area, n, tt, nn;
  };

  inline Segment large_segment(double alpha, double x, double y)
  {
    const double area = alpha - x * y, cube = x * x * x;
    return {area, 2. / 3 * cube - y * area, area / 4 - cube * y / 6,
            area * (.25 + y * y) - 5. / 6 * cube * y};
  }

  /// Coefficients of the same four as power series in x², after x³, x⁵, x⁵ and x⁷.
  struct SegmentSeries
  {
    static constexpr int n_terms = 9; // 64^-9 is below rounding
    double area[n_terms]{}, n[n_terms]{}, tt[n_terms]{}, nn[n_terms]{};
    constexpr SegmentSeries()
    {
      double c = 1, g = 2. / 3; // of 1/sqrt(1-x²), and of asin(x)/sqrt(1-x²) from x³ on
      for (int k = 0; k < n_terms; ++k)
      {
        area[k] = 2 * c / (2 * k + 3);
        tt[k] = 2 * c / (3 * (2 * k + 5));
        n[k] = g / (2 * k + 5);
        c *= (2 * k + 1) / (2. * k + 2);
        g *= (2 * k + 4) / (2. * k + 5);
        nn[k] = 8 * (k + 1) * c / (3. * (2 * k + 5) * (2 * k + 7));
      }
    }
  };
  inline constexpr SegmentSeries series;

  inline Segment small_segment(double x)
  {
    const double z = x * x;
    Segment s{};
    for (int k = z < 1e-4 ? 3 : SegmentSeries::n_terms - 1; k >= 0; --k)
      s = {s.area * z + series.area[k], s.n * z + series.n[k], s.tt * z + series.tt[k],
           s.nn * z + series.nn[k]};
    return {x * z * s.area, x * z * z * s.n, x * z * z * s.tt, x * z * z * z * s.nn};
  }

  /// Green's theorem on the pieces, relative to the first corner; an arc is its chord and a
  /// circular segment, so that nothing is ever taken from the whole disc.
  class MomentSum
  {
  public:
    MomentSum(double radius, Vec centre) : radius_(radius), centre_(centre) {}

    void segment(Vec p, Vec q)
    {
      if (!has_origin_)
        origin_ = p, has_origin_ = true;
      add_chord(p - origin_, q - origin_);
    }

    void arc(Vec p, Vec q, bool is_major)
    {
      segment(p, q);
      const Vec e = q - p, middle = p + .5 * e - centre_;
      const double R = radius_, chord = std::sqrt(dot(e, e)), x = chord / (2 * R);
      Segment s;
      if (!is_major && x < .125)
      {
        if (x == 0)
          return;
        s = small_segment(x);
      }
      else if (!is_major && x < .5)
        s = large_segment(std::asin(x), x, std::sqrt(1 - x * x));
      else
      {
        const double alpha = .5 * arc_angle(p - centre_, q - centre_, is_major);
        s = large_segment(alpha, std::sin(alpha), std::cos(alpha));
      }
      // outwards: from the chord, or, where that is too short to tell, opposite to it
      const Vec n = is_major && x < .5 ? (-1 / std::sqrt(dot(middle, middle))) * middle
                                       : (1 / chord) * Vec{e.y, -e.x};
      const double RR = R * R, a = RR * s.area, f = RR * R * s.n;
      const Vec m = p + .5 * e - origin_;
      area_ += a;
      first_ = first_ + a * m + f * n;
      const double tt = RR * RR * s.tt, nn = RR * RR * s.nn;
      second_[0] += a * m.x * m.x + 2 * f * m.x * n.x + tt * n.y * n.y + nn * n.x * n.x;
      second_[1] += a * m.x * m.y + f * (m.x * n.y + m.y * n.x) + (nn - tt) * n.x * n.y;
      second_[2] += a * m.y * m.y + 2 * f * m.y * n.y + tt * n.x * n.x + nn * n.y * n.y;
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

  private:
    void add_chord(Vec p, Vec q)
    {
      const double w = cross(p, q);
      area_ += w / 2;
      first_ = first_ + (w * (1. / 6)) * (p + q);
      second_[0] += w * (1. / 12) * (p.x * p.x + p.x * q.x + q.x * q.x);
      second_[1] += w * (1. / 24) * (2 * (p.x * p.y + q.x * q.y) + p.x * q.y + q.x * p.y);
      second_[2] += w * (1. / 12) * (p.y * p.y + p.y * q.y + q.y * q.y);
    }

    const double radius_;
    const Vec centre_;
    bool has_origin_ = false;
    Vec origin_{};
    double area_ = 0;
    Vec first_{};
    std::array<double, 3> second_{};
  };
} // namespace plumbline::geometry::detail
