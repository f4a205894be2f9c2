#include "geometry/polygon.h"

#include <deal.II/base/quadrature_lib.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace plumbline::geometry;

namespace
{
  Polygon box(double x0, double y0, double x1, double y1)
  {
    return {Point<2>(x0, y0), Point<2>(x1, y0), Point<2>(x1, y1), Point<2>(x0, y1)};
  }

  double common(const Polygon &a, const Polygon &b)
  {
    return area(overlap(view(a), view(b)));
  }

  /// Convex polygons inscribed in ellipses.
  class RandomPolygons
  {
  public:
    Polygon next()
    {
      const unsigned int n = 3 + random_() % 6;
      const double start = uniform(0, 1), width = uniform(.2, 1), height = uniform(.2, 1);
      const Point<2> centre(uniform(-.7, .7), uniform(-.7, .7));
      Polygon polygon;
      for (unsigned int i = 0; i < n; ++i)
      {
        const double angle = 2 * M_PI * (start + i + uniform(.1, .9)) / n;
        polygon.push_back(centre + Point<2>(width * std::cos(angle), height * std::sin(angle)));
      }
      return polygon;
    }
    double uniform(double from, double to)
    {
      return std::uniform_real_distribution<double>(from, to)(random_);
    }

  private:
    std::mt19937 random_{1};
  };

  /// ∫ x^a y^b over a polygon by Green's theorem, with Gauss's rule on each side.
  double monomial(const Polygon &polygon, unsigned int a, unsigned int b)
  {
    const dealii::QGauss<1> rule((a + b + 3) / 2);
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const auto along = polygon[(i + 1) % polygon.size()] - polygon[i];
      for (unsigned int q = 0; q < rule.size(); ++q)
      {
        const Point<2> at = polygon[i] + rule.point(q)[0] * along;
        sum += rule.weight(q) * along[1] * std::pow(at[0], a + 1) / (a + 1) * std::pow(at[1], b);
      }
    }
    return sum;
  }
} // namespace

TEST(Polygon, area_and_centroid_have_closed_forms)
{
  const Polygon triangle{Point<2>(1, 1), Point<2>(4, 1), Point<2>(1, 3)};
  EXPECT_DOUBLE_EQ(area(view(triangle)), 3);
  EXPECT_NEAR(centroid(view(triangle)).distance(Point<2>(2, 5. / 3)), 0, 1e-15);
  EXPECT_DOUBLE_EQ(area(view(box(-1, -2, 3, 1))), 12);
  EXPECT_NEAR(centroid(view(box(-1, -2, 3, 1))).distance(Point<2>(1, -.5)), 0, 1e-15);
}

TEST(Polygon, contains_its_boundary_and_nothing_outside)
{
  const Polygon square = box(.1, .2, .4, .5);
  for (const Point<2> &inside :
       {Point<2>(.2, .3), Point<2>(.1, .2), Point<2>(.1 + .2, .5), Point<2>(.4, .1 + .2)})
    EXPECT_TRUE(contains(view(square), inside)) << inside;
  for (const Point<2> &outside :
       {Point<2>(.1 - 1e-14, .3), Point<2>(.3, .5 + 1e-14), Point<2>(.6, .2), Point<2>(-.1, .2)})
    EXPECT_FALSE(contains(view(square), outside)) << outside;
}

TEST(Polygon, a_line_cuts_it_in_two_parts_that_add_up)
{
  RandomPolygons random;
  int n_cut = 0;
  for (int trial = 0; trial < 10000; ++trial)
  {
    const Polygon whole = random.next();
    const Point<2> a(random.uniform(-1, 1), random.uniform(-1, 1));
    const Point<2> b(random.uniform(-1, 1), random.uniform(-1, 1));
    const Polygon left = left_of(view(whole), a, b), right = left_of(view(whole), b, a);
    EXPECT_NEAR(area(view(left)) + area(view(right)), area(view(whole)), 1e-15);
    n_cut += !left.empty() && !right.empty();
    for (const auto &vertex : left)
    {
      const auto along = b - a, to = vertex - a;
      EXPECT_GE(along[0] * to[1] - along[1] * to[0], -1e-14);
    }
  }
  EXPECT_GT(n_cut, 3000);
  EXPECT_TRUE(left_of(view(box(0, 0, 1, 1)), Point<2>(0, 0), Point<2>(0, 1)).empty());
  EXPECT_EQ(left_of(view(box(0, 0, 1, 1)), Point<2>(1, 0), Point<2>(1, 1)), box(0, 0, 1, 1));
}

TEST(Overlap, of_squares_is_a_square)
{
  const Polygon square = box(.1, .2, .4, .5);
  EXPECT_EQ(overlap(view(square), view(square)), square);
  EXPECT_EQ(overlap(view(square), view(box(0, 0, 1, 1))), square);
  EXPECT_NEAR(common(box(0, 0, 1, 1), square), .09, 1e-16);
  EXPECT_NEAR(common(square, box(.3, .4, 1, 1)), .01, 1e-16);
  EXPECT_EQ(overlap(view(square), view(box(.3, .4, 1, 1))).size(), 4u);
}

TEST(Overlap, is_empty_where_only_sides_or_corners_touch)
{
  const Polygon square = box(.1, .2, .4, .5);
  const Polygon tip{Point<2>(.4, .3), Point<2>(1, 0), Point<2>(1, 1)};
  const Polygon slope{Point<2>(.4, .2), Point<2>(.7, .5), Point<2>(.1, .8), Point<2>(.1, .5)};
  for (const Polygon &other :
       {box(.4, .2, .7, .5), box(.1 + .3, .1, .9, .9), box(-.2, -.1, .1, .2), box(.4, .5, 1, 1),
        tip, box(.5, .6, .7, .8), Polygon{Point<2>(.1, .5), Point<2>(.4, .5), Point<2>(.3, .9)}})
  {
    EXPECT_TRUE(overlap(view(square), view(other)).empty());
    EXPECT_TRUE(overlap(view(other), view(square)).empty());
  }
  EXPECT_NEAR(common(square, slope), .045, 1e-16); // the half above a diagonal
}

TEST(Overlap, makes_no_slivers_of_sides_that_agree_to_rounding)
{
  // thirds and sevenths, with lattice lines that coincide but are computed differently
  for (int i = 0; i < 21; ++i)
    for (int j = 0; j < 7; ++j)
    {
      const Polygon small = box(i / 21., .5, (i + 1) / 21., .6),
                    large = box(j / 7., 0, j / 7. + 1. / 7, 1);
      const Polygon part = overlap(view(small), view(large));
      EXPECT_EQ(part.size(), i / 3 == j ? 4u : 0u);
      EXPECT_NEAR(area(view(part)), i / 3 == j ? .1 / 21 : 0, 1e-17);
    }
}

TEST(Overlap, of_polygons_that_nearly_agree_is_one_of_them)
{
  RandomPolygons random;
  for (int trial = 0; trial < 2000; ++trial)
  {
    const Polygon a = random.next();
    const double size = std::pow(10, random.uniform(-17, -12));
    Polygon b = a;
    for (auto &vertex : b)
      vertex += size * Point<2>(random.uniform(-1, 1), random.uniform(-1, 1));
    const Polygon part = overlap(view(a), view(b));
    EXPECT_NEAR(area(view(part)), area(view(a)), 1e-15 + 10 * size);
    EXPECT_LE(part.size(), 2 * a.size());
    // convex as the geometry of balls wants it
    EXPECT_NEAR(intersect({Point<2>(), 10}, view(part)).area, area(view(part)), 1e-14);
  }
}

TEST(Overlap, and_the_rest_add_up_to_the_polygon)
{
  RandomPolygons random;
  double worst = 0;
  int n_cut = 0;
  for (int trial = 0; trial < 10000; ++trial)
  {
    const Polygon a = random.next(), b = random.next();
    double sum = common(a, b);
    n_cut += sum > 0;
    Polygon inside = a; // of the sides of b so far
    for (std::size_t i = 0; i < b.size(); ++i)
    {
      const Point<2> &p = b[i], &q = b[(i + 1) % b.size()];
      sum += area(view(left_of(view(inside), q, p)));
      inside = left_of(view(inside), p, q);
    }
    worst = std::max({worst, std::abs(sum - area(view(a))), std::abs(common(a, b) - common(b, a))});
  }
  EXPECT_LE(worst, 1e-15);
  EXPECT_GT(n_cut, 3000);
}

TEST(PolygonRule, integrates_polynomials_of_its_degree_exactly)
{
  RandomPolygons random;
  for (unsigned int degree = 0; degree <= 20; ++degree)
    for (const Polygon &polygon :
         {random.next(), random.next(), box(.1, .2, .7, .4),
          Polygon{Point<2>(0, 0), Point<2>(1, .2), Point<2>(1.3, .7), Point<2>(.3, .5)}})
    {
      const CutRule rule = polygon_rule(view(polygon), degree);
      for (unsigned int a = 0; a <= degree; ++a) // about a corner they are of lower degree, too
      {
        const unsigned int b = degree - a;
        double sum = 0;
        for (std::size_t q = 0; q < rule.points.size(); ++q)
          sum += rule.weights[q] * std::pow(rule.points[q][0], a) * std::pow(rule.points[q][1], b);
        EXPECT_NEAR(sum, monomial(polygon, a, b), 1e-14 * std::pow(1.7, degree)) << degree;
      }
      for (std::size_t q = 0; q < rule.points.size(); ++q)
      {
        EXPECT_GT(rule.weights[q], 0);
        EXPECT_TRUE(contains(view(polygon), rule.points[q]));
      }
    }
}

TEST(PolygonRule, takes_few_points)
{
  const Polygon triangle{Point<2>(0, 0), Point<2>(1, 0), Point<2>(0, 1)};
  EXPECT_EQ(polygon_rule(view(triangle), 1).points.size(), 1u);
  EXPECT_EQ(polygon_rule(view(triangle), 2).points.size(), 3u);
  EXPECT_EQ(polygon_rule(view(triangle), 5).points.size(), 7u);
  EXPECT_EQ(polygon_rule(view(box(0, 0, 1, 1)), 3).points.size(), 4u);
  EXPECT_EQ(polygon_rule(view(box(0, 0, 1, 1)), 5).points.size(), 9u);
  // a corner on a straight side adds none
  const Polygon with_corner{Point<2>(0, 0), Point<2>(.5, 0), Point<2>(1, 0), Point<2>(0, 1)};
  EXPECT_EQ(polygon_rule(view(with_corner), 2).points.size(), 6u - 3);
}
