#include "geometry/polyhedron_clip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace plumbline;
using namespace plumbline::geometry;

namespace
{
  using Vector = dealii::Tensor<1, 3>;

  ClippedPolyhedron cube()
  {
    return {{0, 0, 0}, {1, 1, 1}};
  }

  /// The volumes on both sides of a plane add up, and each is that of a polyhedron that can be
  /// measured otherwise.
  void expect_halves(const ClippedPolyhedron &whole, const Vector &normal, double offset)
  {
    double sum = 0;
    for (const double sign : {1., -1.})
      if (ClippedPolyhedron half = whole; half.clip(sign * normal, sign * offset))
      {
        sum += half.volume();
        const auto placed = half.placed([](const auto &x) { return x; });
        EXPECT_NEAR(placed.moments().volume, half.volume(), 1e-14);
      }
    EXPECT_NEAR(sum, whole.volume(), 1e-11) << normal << " " << offset;
  }
} // namespace

TEST(ClippedPolyhedron, cuts_a_corner_of_a_cube)
{
  ClippedPolyhedron corner = cube();
  ASSERT_TRUE(corner.clip(Vector({1, 1, 1}), .3));
  EXPECT_EQ(corner.vertices().size(), 4u);
  EXPECT_NEAR(corner.volume(), std::pow(.3, 3) / 6, 1e-16);
  ClippedPolyhedron rest = cube();
  ASSERT_TRUE(rest.clip(Vector({-2, -2, -2}), -.6));
  EXPECT_EQ(rest.vertices().size(), 10u);
  EXPECT_NEAR(rest.volume(), 1 - std::pow(.3, 3) / 6, 1e-15);
}

TEST(ClippedPolyhedron, is_empty_or_whole_on_one_side_of_a_plane)
{
  for (const double gap : {.5, 1e-3, 0.})
  {
    ClippedPolyhedron whole = cube(), none = cube();
    EXPECT_TRUE(whole.clip(Vector({1, 0, 0}), 1 + gap));
    EXPECT_NEAR(whole.volume(), 1, 1e-15);
    EXPECT_FALSE(none.clip(Vector({1, 0, 0}), -gap));
    EXPECT_TRUE(none.vertices().empty());
  }
}

// Vertices, edges and faces on the plane, or off it by any distance.
TEST(ClippedPolyhedron, meets_planes_through_vertices_and_edges)
{
  for (const Vector &normal : {Vector({1, 0, 0}), Vector({1, 1, 0}), Vector({1, 1, 1}),
                               Vector({1, -1, 0}), Vector({2, 1, 1}), Vector({1, 1, -2})})
    for (const double offset : {0., .5, 1., 1.5, 2.})
      for (double off = 1e-3; off > 1e-17; off /= 10)
        for (const double sign : {1., -1.})
          expect_halves(cube(), normal, offset + sign * off);
}

TEST(ClippedPolyhedron, is_cut_again_and_again)
{
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> offset(.1, .9);
  for (int i = 0; i < 200; ++i)
  {
    ClippedPolyhedron part = cube();
    for (int k = 0; k < 30; ++k)
    {
      const Vector n({normal(random), normal(random), normal(random)});
      const double at = n * Vector({.5, .5, .5}) + .5 * offset(random) * n.norm();
      expect_halves(part, n, at);
      ASSERT_TRUE(part.clip(n, at)); // the middle of the cube stays
    }
    EXPECT_GT(part.volume(), 0);
  }
}
