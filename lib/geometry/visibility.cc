#include "geometry/visibility.h"

#include <boost/geometry.hpp>
#include <deal.II/boost_adaptors/point.h>

#include <algorithm>

namespace plumbline::geometry
{
  namespace
  {
    /// Twice the area of a triangle, > 0 where c is on the left of the line from a to b.
    double turn(const Point<2> &a, const Point<2> &b, const Point<2> &c)
    {
      return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }

    /// Of all points of both, counter-clockwise.
    Polygon hull(ArrayView<const Point<2>> a, ArrayView<const Point<2>> b)
    {
      boost::geometry::model::multi_point<Point<2>> points(a.begin(), a.end());
      points.insert(points.end(), b.begin(), b.end());
      boost::geometry::model::ring<Point<2>, false, false> result;
      boost::geometry::convex_hull(points, result);
      return Polygon(result.begin(), result.end());
    }

    constexpr double rounding = 1e-12;

    /// Whether a segment has points inside of a convex polygon.
    bool enters(const Cut &cut, const Polygon &polygon)
    {
      double first = 0, last = 1; // of the way from one end to the other
      for (std::size_t i = 0; i < polygon.size(); ++i)
      {
        const Point<2> &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double least = rounding * a.distance(b) * (a.distance(b) + cut[0].distance(cut[1]));
        const double at_first = turn(a, b, cut[0]) - least, at_last = turn(a, b, cut[1]) - least;
        if (at_first <= 0 && at_last <= 0)
          return false;
        const double zero = at_first / (at_first - at_last);
        if (at_first < 0)
          first = std::max(first, zero);
        else if (at_last < 0)
          last = std::min(last, zero);
      }
      return first < last;
    }

    /// Whether each line from a point of one convex polygon to one of the other meets a crack: as
    /// those from vertex to vertex do, the places where they meet it span those of all others.
    bool hides(const Cut &cut, ArrayView<const Point<2>> a, ArrayView<const Point<2>> b)
    {
      const auto is_met = [&](const Cut &line, const Point<2> &p, const Point<2> &q)
      {
        const double least = rounding * line[0].distance_square(line[1]);
        const double at_p = turn(line[0], line[1], p), at_q = turn(line[0], line[1], q);
        return std::min(at_p, at_q) <= least && std::max(at_p, at_q) >= -least;
      };
      for (const Point<2> &p : a)
        for (const Point<2> &q : b)
          if (!is_met(cut, p, q) || !is_met({p, q}, cut[0], cut[1]))
            return false;
      return true;
    }
  } // namespace

  std::vector<Cut> straight_parts(const std::vector<Polyline> &cracks)
  {
    std::vector<Cut> parts;
    for (const Polyline &crack : cracks)
      for (std::size_t i = 1; i < crack.size(); ++i)
        parts.push_back({crack[i - 1], crack[i]});
    return parts;
  }

  Sight find_between(const std::vector<Cut> &cracks, ArrayView<const Point<2>> a,
                     ArrayView<const Point<2>> b, std::vector<Cut> &between)
  {
    between.clear();
    if (cracks.empty())
      return Sight::clear;
    const Box one = bounding_box(a), other = bounding_box(b);
    Polygon around;
    for (const Cut &cut : cracks)
    {
      bool is_apart = false;
      for (unsigned int d = 0; d < 2; ++d)
        is_apart = is_apart ||
                   std::max(cut[0][d], cut[1][d]) < std::min(one.lower[d], other.lower[d]) ||
                   std::min(cut[0][d], cut[1][d]) > std::max(one.upper[d], other.upper[d]);
      if (is_apart)
        continue;
      if (around.empty())
        around = hull(a, b);
      if (!enters(cut, around))
        continue;
      between.push_back(cut);
      if (hides(cut, a, b))
        return Sight::hidden;
    }
    return between.empty() ? Sight::clear : Sight::partial;
  }

  void find_visible(const Point<2> &from, ArrayView<const Point<2>> polygon,
                    const std::vector<Cut> &cracks, std::vector<Polygon> &seen)
  {
    const double sliver = 1e-14 * area(polygon);
    seen.assign(1, Polygon(polygon.begin(), polygon.end()));
    std::vector<Polygon> before;
    for (const Cut &cut : cracks)
    {
      // a to b as seen from its right: hidden is what lies left of a b, of a `from` and of `from` b
      const bool is_left = turn(cut[0], cut[1], from) > 0;
      const Point<2> &a = cut[is_left ? 1 : 0], &b = cut[is_left ? 0 : 1];
      before.swap(seen);
      seen.clear();
      for (Polygon &rest : before)
        for (const auto &[p, q] : {std::pair(a, b), std::pair(a, from), std::pair(from, b)})
        {
          Polygon part = left_of(view(rest), q, p);
          if (part.size() >= 3 && area(view(part)) > sliver)
            seen.push_back(std::move(part));
          rest = left_of(view(rest), p, q);
          if (rest.size() < 3)
            break;
        }
    }
  }

  bool is_at_shadow(const Point<2> &x, double reach, const std::vector<Cut> &cracks,
                    ArrayView<const Point<2>> polygon)
  {
    for (const Cut &crack : cracks)
      for (const Point<2> &end : crack)
      {
        const dealii::Tensor<1, 2> from = x - end;
        const auto is_on_line = [&](const Point<2> &other)
        {
          const dealii::Tensor<1, 2> line = other - end;
          return std::abs(line[0] * from[1] - line[1] * from[0]) <= reach * line.norm();
        };
        if (std::any_of(polygon.begin(), polygon.end(), is_on_line))
          return true;
        for (const Cut &another : cracks)
          if (is_on_line(another[another[0] == end ? 1 : 0]))
            return true;
      }
    return false;
  }
} // namespace plumbline::geometry
