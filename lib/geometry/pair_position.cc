// CGAL's own checks cost ten times what it checks; they guard CGAL, not our input.
#ifndef CGAL_NDEBUG
#define CGAL_NDEBUG
#endif

#include "geometry/pair_position.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/squared_distance_2.h>

#include <algorithm>
#include <vector>

namespace plumbline::geometry
{
  namespace
  {
    using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
    using Number = Kernel::FT;
    using Vertex = Kernel::Point_2;
    using Side = Kernel::Segment_2;

    Vertex exact(const Point<2> &p)
    {
      return {p[0], p[1]};
    }

    /// Squares of the least and the largest distance.
    struct Distances
    {
      Number nearest, farthest;

      Distances(ArrayView<const Point<2>> a, ArrayView<const Point<2>> b)
          : nearest(CGAL::squared_distance(exact(a[0]), exact(b[0]))), farthest(nearest)
      {
        for (const Point<2> &x : a)
          for (const Point<2> &y : b)
            farthest = std::max(farthest, CGAL::squared_distance(exact(x), exact(y)));
        // sets without common inner points are nearest on their boundaries
        for (const Side &e : sides(a))
          for (const Side &f : sides(b))
            nearest = std::min(nearest, CGAL::squared_distance(e, f));
      }

      static std::vector<Side> sides(ArrayView<const Point<2>> polygon)
      {
        std::vector<Side> result;
        for (std::size_t k = 0; k < polygon.size(); ++k)
          result.emplace_back(exact(polygon[k]), exact(polygon[(k + 1) % polygon.size()]));
        return result;
      }

      PairPosition at(const Number &horizon) const
      {
        const Number square = horizon * horizon;
        return farthest <= square  ? PairPosition::inside
               : nearest >= square ? PairPosition::apart
                                   : PairPosition::cut;
      }
    };

    Number shorter(double length)
    {
      return Number(length) * (1 - Number(tie_width));
    }
    Number longer(double length)
    {
      return Number(length) * (1 + Number(tie_width));
    }
  } // namespace

  PairPosition exact_position(ArrayView<const Point<2>> a, ArrayView<const Point<2>> b,
                              double horizon)
  {
    return Distances(a, b).at(Number(horizon));
  }

  Verdict judge(PairPosition taken, ArrayView<const Point<2>> a, ArrayView<const Point<2>> b,
                double horizon)
  {
    const Distances distances(a, b);
    if (distances.at(Number(horizon)) == taken)
      return Verdict::right;
    if (distances.at(shorter(horizon)) == taken || distances.at(longer(horizon)) == taken)
      return Verdict::tie;
    return taken == PairPosition::cut ? Verdict::open : Verdict::wrong;
  }

  Verdict judge_part(const std::array<double, 2> &part, const Point<2> &centre, double radius,
                     const Point<2> &from, const Point<2> &to)
  {
    const auto [first, last] = part;
    const Vertex c = exact(centre), a = exact(from), b = exact(to);
    const Number square = Number(radius) * Number(radius),
                 inner = shorter(radius) * shorter(radius), outer = longer(radius) * longer(radius);
    if (!(last > first))
    {
      const Number nearest = CGAL::squared_distance(c, Side(a, b));
      return nearest >= square ? Verdict::right : nearest >= inner ? Verdict::tie : Verdict::wrong;
    }
    // the distance is convex along the segment: between two points of the circle lies what is
    // inside
    Verdict verdict = Verdict::right;
    const auto look_at = [&](double s, bool is_end)
    {
      const Number distance = CGAL::squared_distance(c, a + Number(s) * (b - a));
      if (distance > outer || (!is_end && distance < inner))
        verdict = Verdict::wrong;
      else if (is_end && distance > square && verdict == Verdict::right)
        verdict = Verdict::tie;
    };
    look_at(first, first == 0);
    look_at(last, last == 1);
    // an end that was left out, but lies inside
    for (const auto &[is_taken, end] : {std::pair(first == 0, a), std::pair(last == 1, b)})
      if (verdict == Verdict::right && !is_taken && CGAL::squared_distance(c, end) < square)
        verdict = Verdict::tie;
    return verdict;
  }
} // namespace plumbline::geometry
