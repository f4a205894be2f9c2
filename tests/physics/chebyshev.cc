#include "physics/chebyshev.h"

#include "base/control_points.h"
#include "physics/panels.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::physics;

namespace
{
  std::optional<ChebyshevField> on_unit_square(const std::function<double(const Point<2> &)> &f)
  {
    return ChebyshevField::resolve([&](const Point<2> &x, unsigned int) { return f(x); }, 1, {0, 0},
                                   {1, 1});
  }

  double bump(const Point<2> &x, const Point<2> &centre, double width)
  {
    return std::exp(-x.distance_square(centre) / (width * width));
  }
} // namespace

TEST(ControlPoints, leave_no_gap_of_two_parts)
{
  for (const std::size_t n : {1u, 2u, 3u, 10u, 64u, 777u})
  {
    const auto points = base::control_points(n);
    ASSERT_EQ(points.size(), n);
    EXPECT_LT(points.front(), .9 / n);
    EXPECT_GT(points.back(), 1 - .9 / n);
    for (std::size_t i = 1; i < n; ++i)
    {
      EXPECT_GT(points[i], points[i - 1]);
      EXPECT_LT(points[i] - points[i - 1], 1.8 / n);
    }
  }
}

TEST(ChebyshevField, takes_as_many_terms_as_a_smooth_field_needs)
{
  const auto f = [](const Point<2> &x) { return std::sin(3 * x[0]) * std::cos(2 * x[1]); };
  const auto series = on_unit_square(f);
  ASSERT_TRUE(series);
  EXPECT_LE(series->n_terms(), 17u);
  for (const double x : base::control_points(7))
    for (const double y : base::control_points(9))
      EXPECT_NEAR((*series)({x, y}, 0), f({x, y}), 1e-14);
  // terms along both axes apart
  const auto along_y = on_unit_square([](const Point<2> &x) { return x[0] + std::pow(x[1], 7); });
  ASSERT_TRUE(along_y);
  EXPECT_EQ(along_y->n_terms(), 8u);
  EXPECT_NEAR((*along_y)({.3, .8}, 0), .3 + std::pow(.8, 7), 1e-14);
}

// The widest gaps of 9 Chebyshev points are 17 % of the side: strips, squares and hats in them
// were all 0.
TEST(ChebyshevField, sees_what_lies_between_its_first_points)
{
  for (const double width : {.15, .05, .025})
    for (const double at : {.1, .33, .585, .9})
    {
      const auto is_in = [&](double x) { return std::abs(x - at) < width / 2; };
      const auto hat = [&](double x) { return std::max(0., 1 - 2 * std::abs(x - at) / width); };
      EXPECT_FALSE(on_unit_square([&](const Point<2> &x) { return is_in(x[0]) ? 1 : 0; }));
      EXPECT_FALSE(on_unit_square([&](const Point<2> &x) { return is_in(x[1]) ? 1 : 0; }));
      EXPECT_FALSE(
          on_unit_square([&](const Point<2> &x) { return is_in(x[0]) && is_in(x[1]) ? 1 : 0; }));
      EXPECT_FALSE(
          on_unit_square([&](const Point<2> &x) { return is_in((x[0] + x[1]) / 2) ? 1 : 0; }));
      EXPECT_FALSE(on_unit_square([&](const Point<2> &x) { return 1 + hat(x[0]) * hat(x[1]); }));
    }
  // small beside what is around, and smooth enough for more terms
  EXPECT_FALSE(on_unit_square(
      [](const Point<2> &x) {
        return 1 + 1e-9 * bump(x, {.58, .58}, .02);
      }));
  const auto wide = on_unit_square([](const Point<2> &x) { return 1 + bump(x, {.58, .58}, .1); });
  ASSERT_TRUE(wide);
  EXPECT_NEAR((*wide)({.58, .58}, 0), 2, 1e-12);
}

// T_16 is 1 or -1 wherever 9 points are, T_8 is 0
TEST(ChebyshevField, is_not_deceived_by_a_field_that_vanishes_at_its_points)
{
  const auto wave = [](double n, double x) { return std::cos(n * std::acos(2 * x - 1)); };
  for (const double n : {9., 18., 27.})
  {
    const auto series = on_unit_square([&](const Point<2> &x) { return wave(n, x[0]); });
    ASSERT_TRUE(series);
    EXPECT_NEAR((*series)({.37, .2}, 0), wave(n, .37), 1e-12) << n;
  }
}

TEST(Panels, are_small_where_a_feature_is_narrow_alone)
{
  const ChebyshevField::Function f = [](const Point<2> &x, unsigned int) {
    return std::cos(x[0]) + bump(x, {.585, .43}, .014);
  };
  const auto terms = [&](const Point<2> &lower, const Point<2> &upper, unsigned int most)
  {
    const auto series = ChebyshevField::resolve(f, 1, lower, upper, 0, {{100, 100}, 9, most});
    return series ? series->n_terms() : 0;
  };
  const auto panels = std::make_shared<const Panels>(Point<2>(0, 0), Point<2>(1, 1), terms);
  EXPECT_GT(panels->all().size(), 10u);
  EXPECT_LT(panels->all().size(), 200u);
  double area = 0;
  for (const Panels::Panel &panel : panels->all())
  {
    EXPECT_GT(panel.n_terms, 0u);
    area += (panel.upper[0] - panel.lower[0]) * (panel.upper[1] - panel.lower[1]);
  }
  EXPECT_NEAR(area, 1, 1e-14);
  const auto width = [&](const Point<2> &x)
  { return panels->at(x).upper[0] - panels->at(x).lower[0]; };
  EXPECT_LE(width({.585, .43}), 1. / 8);
  EXPECT_GE(width({.1, .9}), 1. / 4);
  const PanelField field(f, 1, panels, 0);
  for (const Point<2> &x : {Point<2>(.585, .43), {.6, .44}, {.2, .9}, {0, 1}, {.999, .001}})
  {
    ASSERT_TRUE(field.series(x)) << x;
    EXPECT_NEAR((*field.series(x))(x, 0), f(x, 0), 1e-12) << x;
  }
}

TEST(Panels, leave_a_kink_to_the_field_itself)
{
  const ChebyshevField::Function f = [](const Point<2> &x, unsigned int)
  { return std::abs(x[0] - .37); };
  const auto terms = [&](const Point<2> &lower, const Point<2> &upper, unsigned int most)
  {
    const auto series = ChebyshevField::resolve(f, 1, lower, upper, 0, {{20, 20}, 9, most});
    return series ? series->n_terms() : 0;
  };
  const auto panels = std::make_shared<const Panels>(Point<2>(0, 0), Point<2>(1, 1), terms);
  EXPECT_EQ(panels->at({.37, .6}).n_terms, 0u);
  EXPECT_GT(panels->at({.2, .6}).n_terms, 0u);
  const auto nowhere = [](const Point<2> &, const Point<2> &, unsigned int) { return 0u; };
  EXPECT_LE(Panels({0, 0}, {1, 1}, nowhere).all().size(), 16u);
}
