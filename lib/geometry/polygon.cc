#include "geometry/polygon.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace plumbline::geometry
{
  namespace
  {
    using dealii::Quadrature;
    using dealii::Tensor;

    constexpr double eps = std::numeric_limits<double>::epsilon();

    /// Below this fraction of the smaller polygon's area an overlap is rounding.
    constexpr double no_area = 1e-14;

    double cross(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    /// Largest of the coordinates, without sign: what they are rounded to is eps times that.
    double size(ArrayView<const Point<2>> points)
    {
      double largest = 0;
      for (const auto &point : points)
        largest = std::max({largest, std::abs(point[0]), std::abs(point[1])});
      return largest;
    }

    double length(const Tensor<1, 2> &a)
    {
      return std::abs(a[0]) + std::abs(a[1]);
    }

    /// The part on the left of the line from a to b.
    /// @param result  overwritten
    void clip(ArrayView<const Point<2>> polygon, const Point<2> &a, const Point<2> &b,
              Polygon &result)
    {
      const Tensor<1, 2> along = b - a;
      result.clear();
      const Point<2> *p = polygon.end() - 1;
      double at_p = cross(along, *p - a);
      for (const Point<2> &q : polygon)
      {
        const double at_q = cross(along, q - a);
        if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0))
          result.push_back(*p + at_p / (at_p - at_q) * (q - *p));
        if (at_q >= 0)
          result.push_back(q);
        p = &q;
        at_p = at_q;
      }
    }

    /// Drops the vertices where a polygon turns left by no more than the rounding of its
    /// coordinates, or right: vertices twice, on straight sides, at the tips of slivers. What is
    /// left is convex beyond rounding.
    void tidy(Polygon &polygon)
    {
      const double rounding = 8 * eps * size(view(polygon));
      const auto turns = [&](const Point<2> &p, const Point<2> &q, const Point<2> &r)
      {
        const Tensor<1, 2> a = q - p, b = r - q;
        return cross(a, b) > rounding * (length(a) + length(b));
      };
      std::size_t first = 0, last = 0; // of those that stay, moved to the front
      for (const Point<2> q : polygon)
      {
        while (last >= 2 && !turns(polygon[last - 2], polygon[last - 1], q))
          --last;
        polygon[last++] = q;
      }
      while (last - first >= 3)
        if (!turns(polygon[last - 2], polygon[last - 1], polygon[first]))
          --last;
        else if (!turns(polygon[last - 1], polygon[first], polygon[first + 1]))
          ++first;
        else
          break;
      polygon.resize(last);
      polygon.erase(polygon.begin(), polygon.begin() + first);
      if (polygon.size() < 3)
        polygon.clear();
    }

    bool boxes_meet(ArrayView<const Point<2>> a, ArrayView<const Point<2>> b)
    {
      for (unsigned int d = 0; d < 2; ++d)
      {
        const auto below = [d](const Point<2> &p, const Point<2> &q) { return p[d] < q[d]; };
        const auto of_a = std::minmax_element(a.begin(), a.end(), below);
        const auto of_b = std::minmax_element(b.begin(), b.end(), below);
        if ((*of_a.second)[d] <= (*of_b.first)[d] || (*of_b.second)[d] <= (*of_a.first)[d])
          return false;
      }
      return true;
    }

    bool is_parallelogram(ArrayView<const Point<2>> polygon)
    {
      if (polygon.size() != 4)
        return false;
      const Tensor<1, 2> gap = (polygon[1] - polygon[0]) - (polygon[2] - polygon[3]);
      return length(gap) <= 4 * eps * size(polygon);
    }

    /// On the triangle (0, 0), (1, 0), (0, 1).
    Quadrature<2> make_triangle_rule(unsigned int degree)
    {
      if (degree > 14)
        return dealii::QDuffy((degree + 3) / 2, 1.);
      return dealii::QWitherdenVincentSimplex<2>((degree + 1) / 2, degree % 2 == 1);
    }

    template <class Make>
    const Quadrature<2> &tabulated(std::map<unsigned int, Quadrature<2>> &table,
                                   unsigned int degree, const Make &make)
    {
      const auto place = table.find(degree);
      return place != table.end() ? place->second
                                  : table.emplace(degree, make(degree)).first->second;
    }

    const Quadrature<2> &triangle_rule(unsigned int degree)
    {
      thread_local std::map<unsigned int, Quadrature<2>> known;
      return tabulated(known, std::max(1u, degree), make_triangle_rule);
    }

    const Quadrature<2> &square_rule(unsigned int degree)
    {
      thread_local std::map<unsigned int, Quadrature<2>> known;
      return tabulated(known, degree, [](unsigned int d) { return dealii::QGauss<2>(d / 2 + 1); });
    }

    /// Adds a rule on the unit square or triangle, mapped to the sides s and t from a corner.
    void add(CutRule &rule, const Quadrature<2> &unit, const Point<2> &corner,
             const Tensor<1, 2> &s, const Tensor<1, 2> &t)
    {
      const double stretch = cross(s, t);
      for (unsigned int q = 0; q < unit.size(); ++q)
      {
        rule.points.push_back(corner + unit.point(q)[0] * s + unit.point(q)[1] * t);
        rule.weights.push_back(stretch * unit.weight(q));
      }
    }
  } // namespace

  double area(ArrayView<const Point<2>> polygon)
  {
    double twice = 0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
      twice += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    return twice / 2;
  }

  Point<2> centroid(ArrayView<const Point<2>> polygon)
  {
    double twice = 0;
    Tensor<1, 2> first;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    {
      const Tensor<1, 2> p = polygon[i] - polygon[0], q = polygon[i + 1] - polygon[0];
      twice += cross(p, q);
      first += cross(p, q) / 3 * (p + q);
    }
    return twice == 0 ? polygon[0] : polygon[0] + first / twice;
  }

  bool contains(ArrayView<const Point<2>> polygon, const Point<2> &point)
  {
    const double rounding = 4 * eps * size(polygon);
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const Tensor<1, 2> along = polygon[(i + 1) % polygon.size()] - polygon[i];
      if (cross(along, point - polygon[i]) < -rounding * length(along))
        return false;
    }
    return true;
  }

  Polygon left_of(ArrayView<const Point<2>> polygon, const Point<2> &a, const Point<2> &b)
  {
    Polygon result;
    if (polygon.size() < 3)
      return result;
    result.reserve(polygon.size() + 1);
    clip(polygon, a, b, result);
    tidy(result);
    return result;
  }

  Polygon overlap(ArrayView<const Point<2>> a, ArrayView<const Point<2>> b)
  {
    if (a.size() < 3 || b.size() < 3 || !boxes_meet(a, b))
      return {};
    thread_local Polygon part, rest;
    part.assign(a.begin(), a.end());
    for (std::size_t i = 0; i < b.size(); ++i)
    {
      clip(view(part), b[i], b[(i + 1) % b.size()], rest);
      part.swap(rest);
      if (part.size() < 3)
        return {};
    }
    tidy(part);
    return area(view(part)) > no_area * std::min(area(a), area(b)) ? part : Polygon();
  }

  CutRule polygon_rule(ArrayView<const Point<2>> polygon, unsigned int degree)
  {
    CutRule rule;
    if (is_parallelogram(polygon))
      add(rule, square_rule(degree), polygon[0], polygon[1] - polygon[0], polygon[3] - polygon[0]);
    else
      for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
      {
        const Tensor<1, 2> s = polygon[i] - polygon[0], t = polygon[i + 1] - polygon[0];
        if (cross(s, t) > eps * area(polygon)) // else three corners on a line
          add(rule, triangle_rule(degree), polygon[0], s, t);
      }
    return rule;
  }
} // namespace plumbline::geometry
