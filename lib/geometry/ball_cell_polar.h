#pragma once

#include "geometry/ball_cell_walk.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

/// The rule of polar_rule, private to ball_cell.cc.
namespace plumbline::geometry::detail
{
  /// Gauss's rule on [0, 1].
  struct Gauss
  {
    std::vector<double> at, weight;
  };

  inline Gauss make_gauss(unsigned int n)
  {
    Gauss rule{std::vector<double>(n), std::vector<double>(n)};
    for (unsigned int i = 0; i < n; ++i)
    {
      double x = std::cos(pi * (i + .75) / (n + .5)), slope = 1;
      for (int step = 0; step < 8; ++step) // Newton, from a guess good to two digits or more
      {
        double last = 1, value = x;
        for (unsigned int k = 2; k <= n; ++k)
        {
          const double next = ((2 * k - 1) * x * value - (k - 1) * last) / k;
          last = value;
          value = next;
        }
        slope = n * (x * value - last) / (x * x - 1);
        x -= value / slope;
      }
      rule.at[i] = .5 * (1 - x);
      rule.weight[i] = 1 / ((1 - x * x) * slope * slope);
    }
    return rule;
  }

  inline const Gauss &gauss(unsigned int n)
  {
    thread_local std::map<unsigned int, Gauss> known;
    const auto place = known.find(n);
    return place != known.end() ? place->second : known.emplace(n, make_gauss(n)).first->second;
  }

  /// Collects the points of the polar rule.
  class PolarRule
  {
  public:
    PolarRule(const Ball &ball, Vec centre, unsigned int n_angles, unsigned int n_radii)
        : ball_(ball), centre_(centre), angles_(gauss(n_angles)), radii_(gauss(n_radii))
    {
    }

    /// The triangle or sector between the centre and a piece.
    void add_from_centre(const Piece &piece)
    {
      const Vec p = vec(piece.from) - centre_, q = vec(piece.to) - centre_;
      if (piece.is_arc)
      {
        const unsigned int n_parts = 1 + static_cast<unsigned int>(piece.angle / widest_angle);
        const double part = piece.angle / n_parts, start = std::atan2(p.y, p.x);
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
    void add_band(const std::vector<Piece> &pieces)
    {
      const auto arc =
          std::find_if(pieces.begin(), pieces.end(), [](const Piece &p) { return p.is_arc; });
      const auto square = [&](const Piece &p)
      {
        const Vec x = vec(p.from) - centre_;
        return dot(x, x);
      };
      const auto farthest =
          std::max_element(pieces.begin(), pieces.end(),
                           [&](const Piece &p, const Piece &q) { return square(p) < square(q); });
      const Vec corner = vec((arc != pieces.end() ? arc : farthest)->from);
      const Vec g = corner - centre_;
      const double distance = std::sqrt(dot(g, g));
      base_ = (1 / distance) * g;
      base_radius_ = arc != pieces.end() ? ball_.radius : distance;

      const auto angle = [&](const Point<2> &point)
      {
        const Vec x = vec(point) - corner;
        return std::atan2(cross(base_, x), base_radius_ + dot(base_, x));
      };
      std::vector<Side> sides;
      std::vector<double> breaks;
      for (const Piece &p : pieces)
      {
        const Vec e = vec(p.to) - vec(p.from), x = vec(p.from) - corner;
        Side side{angle(p.from), angle(p.to), p.is_arc};
        if (!p.is_arc)
        {
          side.normal = (1 / std::sqrt(dot(e, e))) * Vec{e.y, -e.x};
          side.along = dot(side.normal, base_);
          side.across = cross(base_, side.normal);
          side.shift = dot(side.normal, x);
        }
        sides.push_back(side);
        breaks.push_back(side.from);
      }
      std::sort(breaks.begin(), breaks.end());
      const double tiny = negligible * (breaks.back() - breaks.front());
      for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
      {
        const double a = breaks[i], b = breaks[i + 1], middle = a + .5 * (b - a);
        const Side *entry = nullptr, *exit = nullptr;
        for (const Side &side : sides)
          if (side.from < middle && middle < side.to)
            exit = &side;
          else if (side.to < middle && middle < side.from)
            entry = &side;
        if (b - a > tiny && entry && exit)
          add_between(*entry, *exit, a, b);
      }
    }

    CutRule rule;

  private:
    struct Side
    {
      double from, to; ///< angles relative to the corner's
      bool is_arc;
      Vec normal{0, 0};
      double along = 0, across = 0; ///< components of the normal, with respect to the corner
      double shift = 0;             ///< of the side's line, from the corner
    };

    /// How far the angles between which the ray meets the side's line reach beyond [a, b].
    static double room(const Side &side, double a, double b)
    {
      if (side.is_arc)
        return pi;
      const double sign = side.to > side.from ? 1 : -1;
      const double middle = a + .5 * (b - a);
      double normal = std::atan2(sign * side.across, sign * side.along);
      normal += 2 * pi * std::round((middle - normal) / (2 * pi));
      return std::min(a - normal, normal - b) + .5 * pi;
    }

    void add_between(const Side &entry, const Side &exit, double a, double b, int depth = 0)
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
        // radius relative to the corner's
        const auto radius = [&](const Side &side)
        {
          return side.is_arc ? 0
                             : (side.shift +
                                base_radius_ * (2 * half * half * side.along - s * side.across)) /
                                   (c * side.along + s * side.across);
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
      std::size_t k = rule.points.size();
      rule.points.resize(k + radii_.at.size());
      rule.weights.resize(k + radii_.at.size());
      for (std::size_t j = 0; j < radii_.at.size(); ++j)
      {
        const double r = from + length * radii_.at[j];
        rule.points[k] = absolute(r * direction, ball_.centre);
        rule.weights[k] = angle * length * radii_.weight[j] * r;
        // where rounding puts a point on the centre it has no weight to speak of: keep 1/r finite
        k += rule.points[k] != ball_.centre;
      }
      rule.points.resize(k);
      rule.weights.resize(k);
    }

    /// Of a length or an angle: what rounding leaves of a zero.
    static constexpr double negligible = 4e-16;
    /// Largest length of an interval, in the angle and in u, and in units of its distance from the
    /// angle at which a side is seen edge-on: with these, 16 points integrate degree 8 times 1/r to
    /// 1e-14 (measured).
    static constexpr double widest_angle = 2.1, widest_u = 2.4, widest_ratio = 1.2;

    const Ball &ball_;
    const Vec centre_;
    const Gauss &angles_, &radii_;
    Vec base_{};
    double base_radius_ = 0;
  };
} // namespace plumbline::geometry::detail
