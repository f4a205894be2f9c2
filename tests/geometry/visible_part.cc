// The visible part of a ball in a body, against areas and moments that are known.
#include "geometry/visible_part.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline::geometry;

namespace
{
  constexpr double tolerance = 1e-9;

  double area_of(const VisibleBody &body, const Ball &ball, FamilyCut expected)
  {
    std::vector<Polygon> visible;
    EXPECT_EQ(body.find(ball, visible), expected);
    return weighted_moments(
        ball, visible, [](double) { return 1.; }, 0)[0];
  }
} // namespace

TEST(VisiblePart, of_whole_balls_is_all)
{
  const VisibleBody plane({}, {}, tolerance);
  EXPECT_NEAR(area_of(plane, {{3, 4}, 2}, FamilyCut::none), 4 * M_PI, 1e-12);
  EXPECT_FALSE(plane.has_surfaces());
  const VisibleBody box(convex_parts({{{{0, 0}, {1, 1}}}, {}}), {}, tolerance);
  EXPECT_NEAR(area_of(box, {{.5, .5}, .5}, FamilyCut::none), .25 * M_PI, 1e-13); // it touches
}

TEST(VisiblePart, of_a_ball_at_a_corner_is_a_quarter)
{
  const VisibleBody box(convex_parts({{{{0, 0}, {1, 1}}}, {}}), {}, tolerance);
  EXPECT_NEAR(area_of(box, {{0, 0}, .5}, FamilyCut::surface), .0625 * M_PI, 1e-13);
  std::vector<Polygon> visible;
  const Ball ball{{0, .5}, .3}; // half of a disc: ∫ x = 2 r³/3, ∫ x² = ∫ y² = π r⁴/8
  box.find(ball, visible);
  const auto moments = weighted_moments(
      ball, visible, [](double) { return 1.; }, 2);
  EXPECT_NEAR(moments[1], 2 * std::pow(.3, 3) / 3, 1e-14);
  EXPECT_NEAR(moments[2], 0, 1e-14);
  EXPECT_NEAR(moments[3], M_PI * std::pow(.3, 4) / 8, 1e-14);
  EXPECT_NEAR(moments[5], M_PI * std::pow(.3, 4) / 8, 1e-14);
}

TEST(VisiblePart, lacks_the_shadow_of_a_crack)
{
  // of a crack from (a, -b) to (a, b) as seen from 0: the sector less the triangle
  const double a = .3, b = .4, r = 1, half = std::atan2(b, a);
  const double shadow = half * r * r - a * b;
  const VisibleBody plane({}, {{{a, -b}, {a, b}}}, tolerance);
  EXPECT_NEAR(area_of(plane, {{0, 0}, r}, FamilyCut::crack), M_PI * r * r - shadow, 1e-12);
  EXPECT_NEAR(area_of(plane, {{-1, 0}, r}, FamilyCut::none), M_PI * r * r, 1e-12); // out of reach
  // edge-on it has no shadow
  EXPECT_NEAR(area_of(plane, {{a, -b - .3}, r}, FamilyCut::none), M_PI * r * r, 1e-12);
  // the same crack with a point more, and in a body that ends there
  const VisibleBody bent({}, {{{a, -b}, {a, 0}, {a, b}}}, tolerance);
  EXPECT_NEAR(area_of(bent, {{0, 0}, r}, FamilyCut::crack), M_PI * r * r - shadow, 1e-12);
  const VisibleBody half_plane(convex_parts({{{{0, -3}, {3, 3}}}, {}}), {{{a, -b}, {a, b}}},
                               tolerance);
  EXPECT_NEAR(area_of(half_plane, {{0, 0}, r}, FamilyCut::crack), .5 * M_PI * r * r - shadow,
              1e-12);
}

TEST(VisiblePart, parts_of_boxes_add_up)
{
  const Domain domain{{{{0, 0}, {2, 1}}, {{1, .5}, {3, 2}}}, {{{1.5, .25}, {2.5, .75}}}};
  double sum = 0;
  for (const Polygon &part : convex_parts(domain))
    sum += area(view(part));
  // 2 + 3 less their overlap .5 and, of the hole, .125 in the first and .25 in the second alone,
  // .125 less of each in common
  EXPECT_NEAR(sum, 2 + 3 - .5 - (.25 * .5 + .25 * 1), 1e-14);
}

TEST(VisiblePart, bonds_cross_cracks_or_touch_their_ends)
{
  const VisibleBody plane({}, {{{0, 0}, {1, 0}, {1, 1}}}, tolerance);
  const auto passage = [&](const Point<2> &p, const Point<2> &q)
  {
    EXPECT_EQ(plane.passage(p, q), plane.passage(q, p));
    return plane.passage(p, q);
  };
  EXPECT_EQ(passage({.5, -1}, {.5, 1}), Passage::crosses);
  EXPECT_EQ(passage({-.5, -1}, {-.5, 1}), Passage::clear);
  EXPECT_EQ(passage({.5, .1}, {.5, 1}), Passage::clear);
  EXPECT_EQ(passage({-.5, -.5}, {.5, .5}), Passage::touches_end);
  EXPECT_EQ(passage({-.5, -.5}, {.5, .5 - 1e-6}), Passage::crosses);
  EXPECT_EQ(passage({.5, .5}, {1.5, -.5}), Passage::crosses); // through the bend
  EXPECT_EQ(passage({-1, 0}, {-.5, 0}), Passage::clear);
}

// A crack is the same in one piece and in two; where one ends on another it has no tip.
TEST(VisiblePart, cracks_may_be_given_in_pieces)
{
  const VisibleBody pieces({}, {{{0, 0}, {.5, 0}}, {{.5, 0}, {1, 0}}, {{.25, 1}, {.25, 0}}},
                           tolerance);
  EXPECT_EQ(pieces.passage({.5, -1}, {.5, 1}), Passage::crosses);
  EXPECT_EQ(pieces.passage({0, -.5}, {.5, .5}), Passage::crosses);
  EXPECT_EQ(pieces.passage({0, 1}, {.5, 1}), Passage::touches_end);
  EXPECT_EQ(pieces.passage({1, -1}, {1, 1}), Passage::touches_end);
}

// A bond through the end of one side or crack that crosses another one crosses.
TEST(VisiblePart, bonds_through_an_end_may_cross_elsewhere)
{
  const VisibleBody two({}, {{{0, 0}, {1, 0}}, {{-1, 1}, {1, 1}, {1, 2}}}, tolerance);
  EXPECT_EQ(two.passage({0, -1}, {0, .5}), Passage::touches_end);
  EXPECT_EQ(two.passage({0, -1}, {0, 2}), Passage::crosses);
  EXPECT_EQ(two.passage({-1.5, 0}, {1.5, 3}), Passage::crosses); // from no end
  EXPECT_EQ(two.passage({-2, 1.5}, {-.5, .75}), Passage::touches_end);
  EXPECT_EQ(two.passage({-1, 2.5}, {2, 1}), Passage::crosses);
  EXPECT_EQ(two.passage({-1, 2.75}, {2, 2}), Passage::clear);
  EXPECT_EQ(two.passage({.5, 2.25}, {1.5, 1.75}), Passage::touches_end);
}

TEST(VisiblePart, segments_leave_a_body_with_a_gap)
{
  const VisibleBody body(convex_parts({{{{0, 0}, {3, 1}}}, {{{1, .5}, {2, 1}}}}), {}, tolerance);
  EXPECT_TRUE(body.holds({.5, .25}, {2.5, .25}));
  EXPECT_TRUE(body.holds({.5, .5}, {2.5, .5})); // along the gap
  EXPECT_FALSE(body.holds({.5, .75}, {2.5, .75}));
  EXPECT_FALSE(body.holds({.5, .45}, {2.5, .6}));
}
