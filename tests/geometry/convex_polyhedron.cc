#include "geometry/convex_polyhedron.h"

#include "base/error.h"

#include <gtest/gtest.h>

namespace plumbline::geometry
{
  using dealii::Point;

  namespace
  {
    std::string refusal(std::vector<Point<3>> vertices,
                        std::vector<ConvexPolyhedron::Indices> faces)
    {
      try
      {
        (void)ConvexPolyhedron(std::move(vertices), std::move(faces));
      }
      catch (const InputError &error)
      {
        return error.what();
      }
      return "";
    }

    const std::vector<Point<3>> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::vector<ConvexPolyhedron::Indices> sides = {
        {0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  } // namespace

  TEST(ConvexPolyhedron, MeasuresATetrahedronInEitherOrientation)
  {
    const Point<3> a(1, 1, 1), b(3, 1, 1), c(1, 4, 1), d(1, 1, 5);
    for (const auto &vertices : {std::array{a, b, c, d}, std::array{a, c, b, d}})
    {
      const SolidMoments m = ConvexPolyhedron::tetrahedron(vertices).moments();
      EXPECT_NEAR(m.volume, 4, 1e-14);
      EXPECT_NEAR(m.centroid.distance({1.5, 1.75, 2}), 0, 1e-14);
      EXPECT_NEAR((m.second[{0, 0}]), 4 * 3. / 80 * 4, 1e-14); // 3/80 V a² along an edge from 0
      EXPECT_NEAR((m.second[{0, 1}]), -4. / 80 * 2 * 3, 1e-14);
    }
  }

  TEST(ConvexPolyhedron, KnowsBoxes)
  {
    const ConvexPolyhedron box = ConvexPolyhedron::box({1, -2, 0}, {2, 3, .5});
    EXPECT_TRUE(box.is_box());
    EXPECT_EQ(box.lower(), Point<3>(1, -2, 0));
    EXPECT_EQ(box.upper(), Point<3>(2, 3, .5));
    std::vector<ConvexPolyhedron::Indices> faces;
    for (const auto &face : box.faces())
      faces.push_back(face.vertices);
    auto sheared = box.vertices(), tapered = sheared;
    for (Point<3> &x : sheared)
      x[0] += x[1] / 8;
    for (Point<3> &x : tapered)
      x[0] += x[0] == 1 && x[1] > 0 ? .5 : 0;
    EXPECT_FALSE(ConvexPolyhedron(sheared, faces).is_box());
    EXPECT_FALSE(ConvexPolyhedron(tapered, faces).is_box());
    EXPECT_FALSE(
        ConvexPolyhedron::tetrahedron({Point<3>(), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}).is_box());
  }

  TEST(ConvexPolyhedron, RefusesWhatIsNone)
  {
    EXPECT_EQ(refusal(corners, sides), "");
    EXPECT_NE(refusal({{0, 0, 0}, {1, 0, 0}}, {}).find("at least 4 vertices"), std::string::npos);
    auto faces = sides;
    faces[0] = {0, 1, 2};
    EXPECT_NE(refusal(corners, faces).find("counter-clockwise seen from outside"),
              std::string::npos);
    faces = sides;
    faces[0] = {0, 2, 7};
    EXPECT_NE(refusal(corners, faces).find("names vertex 7 of 4"), std::string::npos);
    faces = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}};
    EXPECT_NE(refusal(corners, faces).find("written clockwise"), std::string::npos);
    auto flat = corners;
    flat[3] = {.5, .5, 0};
    EXPECT_NE(refusal(flat, sides), "");
    auto infinite = corners;
    infinite[2][1] = 1. / 0.;
    EXPECT_NE(refusal(infinite, sides).find("not finite"), std::string::npos);
    // a cube with one corner pulled out: its faces are not plane
    std::vector<Point<3>> cube = ConvexPolyhedron::box({0, 0, 0}, {1, 1, 1}).vertices();
    cube[7] = {1.2, 1.2, 1.2};
    EXPECT_NE(
        refusal(
            cube,
            {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}})
            .find("split the face into triangles"),
        std::string::npos);
  }
} // namespace plumbline::geometry
