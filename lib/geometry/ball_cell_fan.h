#pragma once

#include "geometry/ball_cell_arc.h"
#include "geometry/ball_cell_plane.h"
#include "geometry/ball_cell_tables.h"

#include <algorithm>
#include <cmath>

/// The rule of cut_rule, private to ball_cell.cc.
namespace plumbline::geometry::detail
{
  /// Fills a rule with points on triangles and on strips. A strip is swept by a line that joins a
  /// point of a side, straight or an arc, to one of a straight base; or to an apex, a base of
  /// length zero.
  class Fan
  {
  public:
    Fan(double radius, Vec centre, const Point<2> &origin, unsigned int degree, CutRule &rule)
        : radius_(radius), centre_(centre), origin_(origin), degree_(degree),
          along_(gauss_of_degree(degree + 1)), rule_(rule)
    {
    }

    void fill(const Sides &sides)
    {
      const unsigned int n = sides.size();
      const auto arc =
          std::find_if(sides.begin(), sides.end(), [](const Side &s) { return s.is_arc; });
      if (n == 1)
        add_image(table<DiscRule>(degree_), centre_, {radius_, 0}, {0, radius_});
      else if (n == 3 && arc == sides.end())
        add_triangle(sides[0].from, sides[1].from, sides[2].from);
      else if (n > 1)
        add_all(sides, arc == sides.end() ? 0 : arc - sides.begin());
      rule_.points.resize(n_points_);
      rule_.weights.resize(n_points_);
    }

  private:
    /// A strip between a side and what lies across of it, another side or a corner; the ends of the
    /// latter are the apexes of all that is left.
    void add_all(const Sides &sides, unsigned int first)
    {
      const unsigned int n = sides.size();
      const auto side = [&](unsigned int i) -> const Side &
      { return sides[first + i < n ? first + i : first + i - n]; };
      const bool has_base = n >= 4 && !side(n / 2).is_arc;
      const unsigned int across = has_base ? n / 2 : (n + 1) / 2;
      const Vec end = side(across).from, start = has_base ? side(across).to : end;
      add_strip(start, end, side(0));
      for (unsigned int i = 1; i < n; ++i)
      {
        const Vec apex = i < across ? end : start;
        if (side(i).is_arc)
          add_strip(apex, apex, side(i));
        else
          add_triangle(apex, side(i).from, side(i).to);
      }
    }

    void add_strip(Vec start, Vec end, const Side &side)
    {
      if (!side.is_arc)
        add_quadrilateral(start, end, side.from, side.to);
      else if (side.is_major)
      {
        const Vec far = centre_ + radius_ * outward(side, centre_), middle = .5 * (start + end);
        add_arc(start, middle, side.from, far);
        add_arc(middle, end, far, side.to);
      }
      else
        add_arc(start, end, side.from, side.to);
    }

    /// A strip to an arc of at most a half circle. The points of its base go like the sine of the
    /// arc's angle: all is a trigonometric polynomial.
    void add_arc(Vec start, Vec end, Vec from, Vec to)
    {
      const Vec half = .5 * (to - from), middle = from + half;
      const Vec half_base = .5 * (end - start), base = start + half_base;
      const double half_chord = std::sqrt(dot(half, half));
      const Vec n = (1 / half_chord) * Vec{half.y, -half.x};
      const double sine = half_chord / radius_; // of half the arc's angle
      const double cosine = sine < .9 ? std::sqrt((1 - sine) * (1 + sine))
                                      : std::max(0., dot(n, middle - centre_) / radius_);
      const double kappa_square = .5 * sine * sine / (1 + cosine);
      const Vec height = 2 * radius_ * kappa_square * n;
      const double scale = 1 / std::sqrt(1 - kappa_square);
      const Vec height_slope = (2 / scale) * height;
      const unsigned int n_angles = degree_ + (same(start, end) ? 2 : 3);
      const auto add = [&](double x, double weight)
      {
        const double xx = x * x, y = scale * x * std::sqrt(1 - kappa_square * xx);
        const double slope = scale * weight * (1 - 2 * kappa_square * xx);
        add_line(along_, base + y * half_base, slope * half_base,
                 middle + y * half + (1 - xx) * height, slope * half - weight * y * height_slope);
      };
      table<ArcRule>(n_angles)(kappa_square, add);
    }

    void add_quadrilateral(Vec start, Vec end, Vec from, Vec to)
    {
      const Vec e = to - from, base = end - start, difference = e - base;
      const double rounding = 4 * eps * eps * dot(e, e);
      const bool is_parallelogram = dot(difference, difference) <= rounding;
      const Gauss &gauss = is_parallelogram ? gauss_of_degree(degree_) : along_;
      for (std::size_t i = 0; i < gauss.at.size(); ++i)
        add_line(gauss, start + gauss.at[i] * base, gauss.weight[i] * base, from + gauss.at[i] * e,
                 gauss.weight[i] * e);
    }

    /// Points on the line from p to q, whose ends move by dp and dq.
    void add_line(const Gauss &gauss, Vec p, Vec dp, Vec q, Vec dq)
    {
      const Vec e = q - p;
      const double at_p = std::max(0., cross(e, dp)), at_q = std::max(0., cross(e, dq));
      if (!(at_p + at_q > 0))
        return; // rounding has left nothing of the strip
      reserve(gauss.at.size());
      for (std::size_t i = 0; i < gauss.at.size(); ++i)
      {
        const double s = gauss.at[i];
        add_point(p + s * e, gauss.weight[i] * (at_p + s * (at_q - at_p)));
      }
    }

    void add_triangle(Vec a, Vec b, Vec c)
    {
      if (cross(b - a, c - a) > 0) // else a side that ends in the apex
        add_image(table<TriangleRule>(degree_), a, b - a, c - a);
    }

    void add_image(const PlaneRule &rule, Vec origin, Vec a, Vec b)
    {
      const double scale = cross(a, b);
      reserve(rule.at.size());
      for (std::size_t i = 0; i < rule.at.size(); ++i)
        add_point(origin + rule.at[i].x * a + rule.at[i].y * b, scale * rule.weight[i]);
    }

    void reserve(std::size_t n)
    {
      if (rule_.points.size() < n_points_ + n)
      {
        rule_.points.resize(n_points_ + n);
        rule_.weights.resize(n_points_ + n);
      }
    }

    void add_point(Vec x, double weight)
    {
      rule_.points[n_points_] = absolute(x, origin_);
      rule_.weights[n_points_++] = weight;
    }

    const double radius_;
    const Vec centre_;
    const Point<2> &origin_;
    const unsigned int degree_;
    const Gauss &along_;
    CutRule &rule_;
    std::size_t n_points_ = 0;
  };
} // namespace plumbline::geometry::detail
