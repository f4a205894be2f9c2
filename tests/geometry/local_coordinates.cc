#include "geometry/local_coordinates.h"

#include "geometry/crack_tips.h"

#include <gtest/gtest.h>

using namespace plumbline::geometry;

TEST(LocalCoordinates, count_from_the_corner_of_what_is_far_away)
{
  EXPECT_EQ(local_origin({{0, 0}, {1, 1}}), Point<2>());
  EXPECT_EQ(local_origin({{5, -2}, {6, 1}}), Point<2>());
  EXPECT_EQ(local_origin({{448250, 5411930}, {448251, 5411931}}), Point<2>(448250, 5411930));
  EXPECT_EQ(local_origin({{0, -5e6}, {1, -5e6 + 2}}), Point<2>(0, -5e6));
  EXPECT_EQ(local_origin({{3e-3, 0}, {3e-3 + 1e-9, 1e-9}}), Point<2>(3e-3, 0)); // in any unit
}

TEST(LocalCoordinates, are_the_decimals_that_were_written)
{
  for (const double origin : {5411930., -448250., 5e6 + .3, 1e9, 123.})
    for (const double decimal : {.35, .1, .0125, 7.2, -.3, 0., 12.3456})
    {
      const double x = std::strtod(std::to_string(origin + decimal).c_str(), nullptr);
      EXPECT_EQ(local_coordinate(x, origin), decimal) << origin << ' ' << decimal;
    }
  EXPECT_EQ(local_coordinate(5e-3 + 3.5e-10, 5e-3), 3.5e-10);
  EXPECT_EQ(local_coordinate(1. / 3, 0), 1. / 3); // as it is
  EXPECT_NEAR(local_coordinate(5e6 + 1. / 3, 5e6), 1. / 3, 5e-9);
}

// Through a vertex of square cells at a horizon of 3 h pass the diagonals: of two and of four half
// cells' length, these on either side, both ways.
TEST(CrackTips, that_lie_on_bonds_are_found)
{
  constexpr double h = .05, horizon = 3 * h;
  for (const Point<2> &shift : {Point<2>(), Point<2>(7, -3)})
  {
    std::vector<Point<2>> nodes;
    for (int j = -10; j < 10; ++j)
      for (int i = 0; i < 20; ++i)
        nodes.push_back(shift + h * Point<2>(i + .5, j + .5));
    const auto found = [&](double x, double y) {
      return tips_on_bonds({{shift + Point<2>(-.1, 0), shift + Point<2>(x, y)}}, nodes, horizon);
    };
    ASSERT_EQ(found(.5, 0).size(), 1u);
    EXPECT_EQ(found(.5, 0)[0].n_bonds, 6u);
    EXPECT_EQ(found(.5, 0)[0].crack, 0u);
    EXPECT_TRUE(found(.501, 0).empty());
    EXPECT_TRUE(found(.5, .001).empty());
  }
  // closed ones have no end
  EXPECT_TRUE(tips_on_bonds({{{0, 0}, {1, 0}, {1, 1}, {0, 0}}}, {{-.1, 0}, {.1, 0}}, 1).empty());
  ASSERT_EQ(tips_on_bonds({{{0, 0}, {1, .5}}}, {{-.1, 0}, {.1, 0}}, 1).size(), 1u);
  EXPECT_NE(tips_on_bonds({{{0, 0}, {1, .5}}}, {{-.1, 0}, {.1, 0}}, 1)[0].text({5, 6}).find(
                "1 bond passes through the end (5, 6) of crack 0"),
            std::string::npos);
}
