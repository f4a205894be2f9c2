// Balls and cells in random and degenerate positions, and how far two moments are apart.
#pragma once

#include "geometry/ball_cell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace plumbline::geometry
{
  using Polygon = std::vector<Point<2>>;
  using Real = long double;
  constexpr Real pi = 3.14159265358979323846264338327950288L;
  constexpr double eps = std::numeric_limits<double>::epsilon();

  /// Claimed in the header, relative to min(|ball|, |polygon|).
  constexpr double accuracy = 1e-13;
  constexpr double ratios[] = {.1, .3, .5, .7, 1, 1.5, 2, 3, 5, 10, 33.3, 100, 1000}; // R/h

  struct Case
  {
    Ball ball;
    Polygon cell;
  };

  inline ArrayView<const Point<2>> view(const Polygon &cell)
  {
    return {cell.data(), cell.size()};
  }
  inline Moments moments(const Case &c, Backend backend = Backend::fast)
  {
    return intersect(c.ball, view(c.cell), backend);
  }

  inline Polygon box(double x0, double x1, double y0, double y1)
  {
    return {Point<2>(x0, y0), Point<2>(x1, y0), Point<2>(x1, y1), Point<2>(x0, y1)};
  }

  inline Polygon box(const Point<2> &lower, double h)
  {
    const auto corners = square(lower, h);
    return {corners.begin(), corners.end()};
  }

  inline double area(const Polygon &cell)
  {
    double twice = 0;
    for (std::size_t i = 1; i + 1 < cell.size(); ++i)
    {
      const auto a = cell[i] - cell[0], b = cell[i + 1] - cell[0];
      twice += a[0] * b[1] - a[1] * b[0];
    }
    return twice / 2;
  }

  inline double diameter(const Polygon &cell)
  {
    double d = 0;
    for (const auto &a : cell)
      for (const auto &b : cell)
        d = std::max(d, a.distance(b));
    return d;
  }

  inline double least_area(const Case &c)
  {
    return std::min(area(c.cell), double(pi) * c.ball.radius * c.ball.radius);
  }
  inline double least_length(const Case &c)
  {
    return std::min(diameter(c.cell), 2 * c.ball.radius);
  }
  inline Point<2> origin(const Case &c)
  {
    return diameter(c.cell) < c.ball.radius ? c.cell[0] : c.ball.centre;
  }

  /// Adds without loss (Neumaier): a million equal terms would round all the same way.
  struct Sum
  {
    Real total = 0, lost = 0;
    void operator+=(Real x)
    {
      const Real next = total + x;
      lost += std::abs(total) > std::abs(x) ? (total - next) + x : (x - next) + total;
      total = next;
    }
    operator Real() const { return total + lost; }
  };

  /// Area, first and second moments about a point: these add up.
  inline std::array<Real, 6> about(const Moments &m, const Point<2> &origin)
  {
    const Real a = m.area, x = Real(m.centroid[0]) - origin[0], y = Real(m.centroid[1]) - origin[1];
    return {
        a, a * x, a * y, m.second[0] + a * x * x, m.second[1] + a * x * y, m.second[2] + a * y * y};
  }

  /// Largest difference of the six, relative to the smaller of cell and ball, less what the
  /// rounding of the centroid's own coordinates brings in.
  inline double difference(const std::array<Real, 6> &a, const std::array<Real, 6> &b,
                           const Case &c)
  {
    const double length = least_length(c);
    const double far = (c.ball.centre.norm() + c.cell[0].norm() + c.cell[2].norm()) / length;
    double worst = 0;
    for (int i = 0; i < 6; ++i)
    {
      const int degree = i == 0 ? 0 : i < 3 ? 1 : 2;
      const double unit = least_area(c) * std::pow(length, degree);
      worst = std::max(worst, double(std::abs(a[i] - b[i])) / unit - degree * eps * far);
    }
    return worst;
  }

  inline double backends_differ_by(const Case &c)
  {
    return difference(about(moments(c), origin(c)), about(moments(c, Backend::cgal), origin(c)), c);
  }

  /// Polygons on an ellipse whose boundary or interior meets the circle.
  class RandomCases
  {
  public:
    explicit RandomCases(unsigned int seed) : engine_(seed) {}

    double uniform(double a, double b)
    {
      return std::uniform_real_distribution<double>(a, b)(engine_);
    }

    /// About `middle`, of size h, 4 to 20 vertices.
    Polygon polygon(const Point<2> &middle, double h)
    {
      const int n = static_cast<int>(uniform(4, 21));
      const double turn = uniform(0, 7), thin = uniform(.2, 1);
      Polygon cell;
      for (int i = 0; i < n; ++i)
      {
        const double t = 2 * double(pi) * (i + uniform(0, .7)) / n;
        const double x = h * std::cos(t), y = h * thin * std::sin(t);
        cell.push_back(middle + Point<2>(x * std::cos(turn) - y * std::sin(turn),
                                         x * std::sin(turn) + y * std::cos(turn)));
      }
      return cell;
    }

    Case next(double ratio)
    {
      const Point<2> centre(uniform(-1, 1), uniform(-1, 1));
      const double h = std::pow(10., uniform(-2, 1)), radius = ratio * h, t = uniform(0, 7);
      const double away = std::max(0., radius + uniform(-1.2, 1.2) * h);
      const Point<2> middle = centre + away * Point<2>(std::cos(t), std::sin(t));
      if (uniform(0, 1) < .5)
        return {{centre, radius}, polygon(middle, h)};
      return {{centre, radius}, box(Point<2>(middle[0] - h / 2, middle[1] - h / 2), h)};
    }

  private:
    std::mt19937_64 engine_;
  };

  /// The circle against a side of a box, `gap` R beyond tangency, for boxes on either side of it.
  inline std::vector<Case> against_a_side(double gap)
  {
    std::vector<Case> cases;
    for (double ratio : ratios)
      for (double slide : {0., .5, .31, 2.})
      {
        const double R = ratio, d = R * (1 + gap);
        cases.push_back({{Point<2>(), R}, box(slide - .5, slide + .5, d, d + 1)});
        cases.push_back({{Point<2>(), R}, box(slide - .5, slide + .5, d - 1, d)});
        cases.push_back({{Point<2>(), R}, box(d, d + 1, slide - .5, slide + .5)});
        cases.push_back({{Point<2>(), R}, box(-d, -d + 1, slide - .5, slide + .5)});
        const auto turned = [&](double x, double y) { // by the (3,4,5) angle
          return Point<2>(.6 * x - .8 * y, .8 * x + .6 * y);
        };
        cases.push_back({{Point<2>(), R},
                         {turned(slide - .5, d), turned(slide + .5, d), turned(slide + .5, d + 1),
                          turned(slide - .5, d + 1)}});
      }
    return cases;
  }

  /// Circles through a corner of a polygon, or within rounding of one.
  inline std::vector<Case> through_corners(unsigned int seed)
  {
    RandomCases random(seed);
    std::vector<Case> cases;
    for (double ratio : ratios)
      for (int trial = 0; trial < 10; ++trial)
      {
        const Polygon cell = random.polygon(Point<2>(.3, .2), 1);
        const double t = random.uniform(0, 7);
        const Point<2> centre = cell[0] + ratio * Point<2>(std::cos(t), std::sin(t));
        for (double off : {0., 1e-15, -1e-15, 1e-12, -1e-12})
          cases.push_back({{centre, centre.distance(cell[0]) * (1 + off)}, cell});
      }
    return cases;
  }

  /// Balls about corners and points of sides.
  inline std::vector<Case> about_corners_and_sides(unsigned int seed)
  {
    RandomCases random(seed);
    std::vector<Case> cases;
    for (double ratio : ratios)
      for (int trial = 0; trial < 10; ++trial)
      {
        const Polygon cell = random.polygon(Point<2>(.3, .2), 1);
        const double s = random.uniform(0, 1);
        cases.push_back({{cell[1], ratio}, cell});
        cases.push_back({{cell[1] + s * (cell[2] - cell[1]), ratio}, cell});
      }
    return cases;
  }

  /// The unit square with vertices that are repeated, or in the middle of a side.
  inline Polygon crowded_square()
  {
    return {Point<2>(0, 0), Point<2>(0, 0), Point<2>(.5, 0), Point<2>(1, 0),  Point<2>(1, .3),
            Point<2>(1, 1), Point<2>(1, 1), Point<2>(0, 1),  Point<2>(0, .5), Point<2>(0, 0)};
  }

  inline double worst_of(const std::vector<Case> &cases)
  {
    double worst = 0;
    for (const Case &c : cases)
      worst = std::max(worst, backends_differ_by(c));
    ::testing::Test::RecordProperty("worst", std::to_string(worst * 1e15) + "e-15");
    return worst;
  }
} // namespace plumbline::geometry
