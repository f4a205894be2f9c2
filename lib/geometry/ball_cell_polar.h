#pragma once

#include "geometry/ball_cell_moments.h"
#include "geometry/ball_cell_plane.h"
#include "geometry/ball_cell_tables.h"

#include <algorithm>
#include <cmath>
#include <vector>

/// The rule of polar_rule, private to ball_cell.cc.
namespace plumbline::geometry::detail
{
  /// Collects the points of the polar rule.
  class PolarRule
  {
  public:
    PolarRule(const Ball &ball, Vec centre, unsigned int n_angles, unsigned int n_radii,
              CutRule &rule)
        : ball_(ball), centre_(centre), angles_(table<Gauss>(n_angles)),
          radii_(table<Gauss>(n_radii)), rule_(rule)
    {
    }

    /// The triangle or sector between the centre and a side.
    void add_from_centre(const Side &side)
    {
      const Vec p = side.from - centre_, q = side.to - centre_;
      if (side.is_arc)
      {
        const double whole = arc_angle(p, q, side.is_major);
        const unsigned int n_parts = 1 + static_cast<unsigned int>(whole / widest_angle);
        const double part = whole / n_parts, start = std::atan2(p.y, p.x);
        for (unsigned int k = 0; k < n_parts; ++k)
          for (std::size_t i = 0; i < angles_.at.size(); ++i)
          {
            const double angle = start + part * (k + angles_.at[i]);
            add_ray({std::cos(angle), std::sin(angle)}, part * angles_.weight[i], 0, ball_.radius);
          }
        return;
      }
      // along the segment at d n + d sinh(u) t: the distance d cosh u is free of the root that
      // would spoil the rule near the foot
      const Vec e = q - p;
      const double length = std::sqrt(dot(e, e)), d = cross(p, q) / length;
      if (!(d > negligible * length))
        return;
      const Vec t = (1 / length) * e, n{t.y, -t.x};
      const double from = std::asinh(dot(p, t) / d), to = std::asinh(dot(q, t) / d);
      const unsigned int n_parts = 1 + static_cast<unsigned int>((to - from) / widest_u);
      const double part = (to - from) / n_parts;
      for (unsigned int k = 0; k < n_parts; ++k)
        for (std::size_t i = 0; i < angles_.at.size(); ++i)
        {
          const double exp_u = std::exp(from + part * (k + angles_.at[i]));
          const double cosh_u = .5 * (exp_u + 1 / exp_u), sinh_u = .5 * (exp_u - 1 / exp_u);
          add_ray((1 / cosh_u) * (n + sinh_u * t), part * angles_.weight[i] / cosh_u, 0,
                  d * cosh_u);
        }
    }

    /// The region of a ball whose centre is outside of it, seen in a half plane: angles relative to
    /// one corner, radii relative to that corner's, so that a small region far from the centre
    /// loses no digits.
    void add_band(const Sides &sides)
    {
      const auto arc =
          std::find_if(sides.begin(), sides.end(), [](const Side &s) { return s.is_arc; });
      const auto square = [&](const Side &side)
      {
        const Vec x = side.from - centre_;
        return dot(x, x);
      };
      const auto farthest =
          std::max_element(sides.begin(), sides.end(),
                           [&](const Side &a, const Side &b) { return square(a) < square(b); });
      const Vec corner = (arc != sides.end() ? arc : farthest)->from;
      const Vec g = corner - centre_;
      const double distance = std::sqrt(dot(g, g));
      base_ = (1 / distance) * g;
      base_radius_ = arc != sides.end() ? ball_.radius : distance;

      const auto angle = [&](Vec point)
      {
        const Vec x = point - corner;
        return std::atan2(cross(base_, x), base_radius_ + dot(base_, x));
      };
      std::vector<Seen> all;
      std::vector<double> breaks;
      for (const Side &side : sides)
      {
        const Vec e = side.to - side.from, x = side.from - corner;
        depth_ = std::max(depth_, std::sqrt(dot(x, x)));
        Seen seen{angle(side.from), angle(side.to), side.is_arc};
        if (!side.is_arc)
        {
          const Vec normal = (1 / std::sqrt(dot(e, e))) * Vec{e.y, -e.x};
          seen.along = dot(normal, base_);
          seen.across = cross(base_, normal);
          seen.shift = dot(normal, x);
        }
        all.push_back(seen);
        breaks.push_back(seen.from);
      }
      std::sort(breaks.begin(), breaks.end());
      const double tiny = negligible * (breaks.back() - breaks.front());
      for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
      {
        const double a = breaks[i], b = breaks[i + 1], middle = a + .5 * (b - a);
        const Seen *entry = nullptr, *exit = nullptr;
        for (const Seen &side : all)
          if (side.from < middle && middle < side.to)
            exit = &side;
          else if (side.to < middle && middle < side.from)
            entry = &side;
        if (b - a > tiny && entry && exit)
          add_between(*entry, *exit, a, b);
      }
    }

  private:
    /// A side as the centre sees it.
    struct Seen
    {
      double from, to; ///< angles relative to the corner's
      bool is_arc;
      double along = 0, across = 0; ///< components of the normal, with respect to the corner
      double shift = 0;             ///< of the side's line, from the corner
    };

    /// How far the angles between which the ray meets the side's line reach beyond [a, b], and no
    /// less than the rounding of such an angle: of what is smaller nothing is known, and halving
    /// until it is larger would go on in every half.
    static double room(const Seen &side, double a, double b)
    {
      if (side.is_arc)
        return pi;
      const double sign = side.to > side.from ? 1 : -1;
      const double middle = a + .5 * (b - a);
      double normal = std::atan2(sign * side.across, sign * side.along);
      normal += 2 * pi * std::round((middle - normal) / (2 * pi));
      return std::max(std::min(a - normal, normal - b) + .5 * pi, rounding);
    }

    void add_between(const Seen &entry, const Seen &exit, double a, double b, int depth = 0)
    {
      constexpr int deepest = 50; // halvings: then the interval is rounding
      const double widest = std::min(
          {widest_angle, widest_ratio * room(entry, a, b), widest_ratio * room(exit, a, b)});
      if (b - a > widest && depth < deepest)
      {
        const double middle = a + .5 * (b - a);
        add_between(entry, exit, a, middle, depth + 1);
        add_between(entry, exit, middle, b, depth + 1);
        return;
      }
      for (std::size_t i = 0; i < angles_.at.size(); ++i)
      {
        const double angle = a + (b - a) * angles_.at[i];
        const double s = std::sin(angle), c = std::cos(angle), half = std::sin(.5 * angle);
        // relative to the corner's, which is the largest; a side seen edge-on is rounding
        const auto radius = [&](const Seen &side)
        {
          if (side.is_arc)
            return 0.;
          const double shift =
              side.shift + base_radius_ * (2 * half * half * side.along - s * side.across);
          return std::clamp(shift / (c * side.along + s * side.across), -depth_, 0.);
        };
        const double in = std::max(radius(entry), -base_radius_), out = radius(exit);
        add_ray({c * base_.x - s * base_.y, s * base_.x + c * base_.y}, (b - a) * angles_.weight[i],
                base_radius_ + in, out - in);
      }
    }

    void add_ray(Vec direction, double angle, double from, double length)
    {
      if (!(angle > 0 && length > 0))
        return;
      std::size_t k = rule_.points.size();
      rule_.points.resize(k + radii_.at.size());
      rule_.weights.resize(k + radii_.at.size());
      for (std::size_t j = 0; j < radii_.at.size(); ++j)
      {
        const double r = from + length * radii_.at[j];
        rule_.points[k] = absolute(r * direction, ball_.centre);
        rule_.weights[k] = angle * length * radii_.weight[j] * r;
        // where rounding puts a point on the centre it has no weight to speak of: keep 1/r finite
        k += rule_.points[k] != ball_.centre;
      }
      rule_.points.resize(k);
      rule_.weights.resize(k);
    }

    /// Of a length or an angle: what rounding leaves of a zero.
    static constexpr double negligible = 4e-16;
    /// Of the difference of two angles of the size of π/2, each known to one unit in its last
    /// place.
    static constexpr double rounding = 4 * eps;
    /// Largest length of an interval, in the angle and in u, and in units of its distance from the
    /// angle at which a side is seen edge-on: with these, 16 points integrate degree 8 times 1/r to
    /// 1e-14 (measured).
    static constexpr double widest_angle = 2.1, widest_u = 2.4, widest_ratio = 1.2;

    const Ball &ball_;
    const Vec centre_;
    const Gauss &angles_, &radii_;
    CutRule &rule_;
    Vec base_{};
    double base_radius_ = 0;
    double depth_ = 0; ///< distance from the corner within which the region lies
  };
} // namespace plumbline::geometry::detail
