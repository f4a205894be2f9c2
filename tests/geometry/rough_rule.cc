#include "geometry/rough_rule.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline::geometry;

namespace
{
  const Polygon unit_square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, triangle = {{0, 0}, {2, 0}, {0, 1}},
                pentagon = {{0, 0}, {2, 0}, {3, 1}, {1, 2}, {-1, 1}};

  RoughRule rule_for(const Polygon &cell, const RoughRule::Value &f, std::size_t n_cells = 1)
  {
    return {9, n_cells, [&](std::size_t) { return cell; }, f};
  }

  double integral(const Polygon &cell, const RoughRule::Value &f)
  {
    return rule_for(cell, f).integral(cell, f);
  }
} // namespace

TEST(RoughRule, integrates_jumps_and_kinks)
{
  const auto step = [](const Point<2> &x) { return x[0] < .3791 ? 1. : 0.; };
  EXPECT_NEAR(integral(unit_square, step), .3791, 5e-4); // 2^-8 / 10
  const auto strip = [](const Point<2> &x) { return x[1] > .43 && x[1] < .58 ? 5. : 0.; };
  EXPECT_NEAR(integral(unit_square, strip), .75, 1e-2);
  const auto disk = [](const Point<2> &x) { return x.distance({.4, .55}) < .31 ? 1. : 0.; };
  EXPECT_NEAR(integral(unit_square, disk), M_PI * .31 * .31, 5e-4);
  const auto kink = [](const Point<2> &x) { return std::abs(x[0] - .3791); };
  EXPECT_NEAR(integral(unit_square, kink), (.3791 * .3791 + .6209 * .6209) / 2, 1e-7);
  // half planes: areas by cutting
  for (const Polygon &cell : {triangle, pentagon})
  {
    const auto diagonal = [](const Point<2> &x) { return x[0] + 2 * x[1] < .9 ? 1. : 0.; };
    const Polygon left = left_of(view(cell), {-1.1, 1}, {2.9, -1});
    const double below = area(view(cell)) - area(view(left));
    EXPECT_NEAR(integral(cell, diagonal), below, 1e-3 * area(view(cell)));
  }
}

TEST(RoughRule, takes_no_parts_where_a_field_is_smooth)
{
  const auto f = [](const Point<2> &x) { return 3 + x[0] - std::pow(x[1], 5) * x[0]; };
  for (const Polygon &cell : {unit_square, triangle, pentagon})
  {
    RoughRule::Sampled sampled;
    rule_for(cell, f).sample(cell, f, sampled);
    const CutRule plain = polygon_rule(view(cell), 9);
    ASSERT_EQ(sampled.values.size(), plain.points.size());
    for (std::size_t q = 0; q < plain.points.size(); ++q)
    {
      EXPECT_EQ(sampled.rule.weights[q], plain.weights[q]);
      EXPECT_EQ(sampled.values[q], f(plain.points[q]));
    }
  }
}

TEST(RoughRule, sees_a_strip_of_a_seventh_of_a_cell_wherever_it_is)
{
  for (double at = .01; at < .85; at += .0137)
  {
    const auto strip = [at](const Point<2> &x)
    { return x[0] > at && x[0] < at + 1. / 7 ? 1. : 0.; };
    EXPECT_NEAR(integral(unit_square, strip), 1. / 7, .025) << at;
  }
}

TEST(RoughRule, goes_less_deep_where_all_cells_are_rough)
{
  const auto rough = [](const Point<2> &x)
  { return std::sin(300 * x[0]) > 0 ? std::sin(500 * x[1]) : 0; };
  const auto smooth = [](const Point<2> &) { return 1.; };
  EXPECT_EQ(rule_for(unit_square, rough, 100000).depth(), 1u);
  EXPECT_GE(rule_for(unit_square, smooth, 100000).depth(), 3u);
  EXPECT_EQ(rule_for(unit_square, [](const Point<2> &x) { return x[0] < .3 ? 1. : 0.; }).depth(),
            8u);
  // rough all over: four times as many parts at each depth
  EXPECT_LE(rule_for(unit_square, rough).depth(), 7u);
  RoughRule::Sampled sampled;
  rule_for(unit_square, rough).sample(unit_square, rough, sampled);
  EXPECT_LE(sampled.values.size(), 1000000u);
}
