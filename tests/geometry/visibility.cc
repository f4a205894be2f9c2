// What is seen past cracks, against points that are looked at one by one.
#include "tests/geometry/crossing.h"

#include <gtest/gtest.h>

#include <random>

using namespace plumbline::geometry;

TEST(Visibility, is_that_of_each_point)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto point = [&](double x, double y, double size)
  { return Point<2>(x + size * number(random), y + size * number(random)); };
  unsigned int n_seen = 0, n_hidden = 0;
  for (unsigned int trial = 0; trial < 200; ++trial)
  {
    const Polygon cell = {point(1, 0, .3), point(2, 0, .3), point(2, 1, .3), point(1, 1, .3)};
    const Point<2> x = point(0, 0, .5);
    std::vector<Cut> cracks;
    for (unsigned int k = 0; k <= trial % 3; ++k)
      cracks.push_back({point(.8, .3, 1), point(.8, .3, 1)});
    std::vector<Polygon> seen;
    find_visible(x, view(cell), cracks, seen);
    for (const Polygon &part : seen)
      EXPECT_GT(area(view(part)), 0);
    for (unsigned int k = 0; k < 50; ++k)
    {
      const double s = .5 + .5 * number(random), t = .5 + .5 * number(random);
      Point<2> y;
      for (unsigned int d = 0; d < 2; ++d)
        y[d] = (1 - s) * (1 - t) * cell[0][d] + s * (1 - t) * cell[1][d] + s * t * cell[2][d] +
               (1 - s) * t * cell[3][d];
      const bool is_hidden = std::any_of(cracks.begin(), cracks.end(),
                                         [&](const Cut &cut) { return crosses(cut, x, y); });
      const auto n_parts = std::count_if(seen.begin(), seen.end(),
                                         [&](const Polygon &p) { return contains(view(p), y); });
      EXPECT_EQ(n_parts, is_hidden ? 0 : 1) << trial;
      ++(is_hidden ? n_hidden : n_seen);
    }
  }
  EXPECT_GT(n_hidden, 1000u);
  EXPECT_GT(n_seen, 1000u);
}

TEST(Visibility, cracks_between_cells_are_those_that_bonds_meet)
{
  const Polygon left = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, right = {{3, 0}, {4, 0}, {4, 1}, {3, 1}},
                beside = {{1, 0}, {2, 0}, {2, 1}, {1, 1}};
  const auto look = [&](const Cut &cut, const Polygon &a, const Polygon &b)
  {
    std::vector<Cut> found;
    const Sight sight = find_between({cut}, view(a), view(b), found);
    EXPECT_EQ(found.empty(), sight == Sight::clear);
    return sight;
  };
  EXPECT_EQ(look({{{2, -1}, {2, .5}}}, left, right), Sight::partial);
  EXPECT_EQ(look({{{1.9, .4}, {2.1, .6}}}, left, right), Sight::partial); // inside of their hull
  EXPECT_EQ(look({{{2, -1}, {2, -.1}}}, left, right), Sight::clear);
  EXPECT_EQ(look({{{0, 0}, {4, 0}}}, left, right), Sight::clear); // along a side of it
  EXPECT_EQ(look({{{2, -1}, {2, .5}}}, left, left), Sight::clear);
  EXPECT_EQ(look({{{.5, -1}, {.5, .5}}}, left, left), Sight::partial); // through a cell
  EXPECT_EQ(look({{{1, -1}, {1, 2}}}, left, left), Sight::clear);      // on its side
  EXPECT_EQ(look({{{2, -.1}, {2, 1.1}}}, left, right), Sight::hidden);
  EXPECT_EQ(look({{{2, 0}, {2, 1}}}, left, right), Sight::hidden);
  EXPECT_EQ(look({{{2, .1}, {2, 1}}}, left, right), Sight::partial);
  EXPECT_EQ(look({{{1, 0}, {1, 1}}}, left, beside), Sight::hidden); // on the side of both
  EXPECT_EQ(look({{{1, 0}, {1, .9}}}, left, beside), Sight::partial);
  EXPECT_EQ(straight_parts({{{0, 0}, {1, 0}, {1, 1}}, {{2, 2}, {3, 3}}}).size(), 3u);
}
