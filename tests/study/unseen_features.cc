// What lies between nodes and is seen by none of them, and what is not to be taken for it.
#include "study/unseen_features.h"

#include "base/error.h"
#include "scene/problem.h"
#include "scene/scene.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::study;
using dealii::Point;

namespace
{
  /// n by n nodes at the centres of the cells of a box.
  PlacesBetweenNodes lattice(int n, const Point<2> &lower = {}, double side = 1)
  {
    PlacesBetweenNodes places;
    const double h = side / n;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
      {
        const Point<2> a = lower + h * Point<2>(i, j);
        places.nodes.push_back(a + Point<2>(h / 2, h / 2));
        places.cells.push_back({a, a + Point<2>(h, 0), a + Point<2>(h, h), a + Point<2>(0, h)});
        if (i + 1 < n)
          places.middles_of_bonds.push_back(a + Point<2>(h, h / 2));
      }
    return places;
  }

  std::vector<std::string> found(const std::function<double(const Point<2> &)> &value,
                                 const PlacesBetweenNodes &places, double h = .05)
  {
    return unseen_features({{"Material/E", value}}, places, h);
  }
} // namespace

TEST(UnseenFeatures, layers_between_nodes_are_found_with_numbers)
{
  const PlacesBetweenNodes places = lattice(20);
  const auto layer = [](const Point<2> &x) { return std::abs(x[0] - .5) < .02 ? .001 : 1.; };
  const auto warnings = found(layer, places);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(
      warnings[0],
      "Material/E has features between nodes that no node resolves: at h = 0.05 it is 0.001 in "
      "40 of 400 cells and at the midpoints of 20 of 380 bonds, but 1 at the surrounding nodes");
  // thin, stiff, oblique, a spot
  EXPECT_EQ(
      found([](const Point<2> &x) { return std::abs(x[0] - .5) < .002 ? 50. : 1.; }, places).size(),
      1u);
  EXPECT_EQ(found([](const Point<2> &x)
                  { return std::abs(x[0] + .37 * x[1] - .7) < .003 ? .5 : 1.; },
                  places)
                .size(),
            1u);
  EXPECT_EQ(found(
                [](const Point<2> &x) {
                  return x.distance({.5, .5}) < .02 ? 3. : 1.;
                },
                places)
                .size(),
            1u);
}

TEST(UnseenFeatures, what_nodes_see_is_none)
{
  const PlacesBetweenNodes places = lattice(20);
  const auto is_seen = [&](const std::function<double(const Point<2> &)> &value)
  { return found(value, places).empty(); };
  EXPECT_TRUE(is_seen([](const Point<2> &) { return 7.; }));
  EXPECT_TRUE(is_seen([](const Point<2> &x) { return x[0] < .51 ? 1. : 100.; })); // two phases
  EXPECT_TRUE(is_seen([](const Point<2> &x) { return std::abs(x[0] - .5) < .03 ? .001 : 1.; }));
  EXPECT_TRUE(is_seen([](const Point<2> &x) { return 1.5 + std::sin(6 * x[0]) * x[1]; }));
  EXPECT_TRUE(is_seen([](const Point<2> &x) { return 1e-9 * std::exp(3 * x[0]); }));
}

TEST(UnseenFeatures, are_the_same_far_from_the_origin_and_in_other_units)
{
  const auto layer = [](double x) { return std::abs(x - .5) < .02 ? .001 : 1.; };
  for (const double unit : {1e-9, 1., 1e6})
  {
    const Point<2> origin(5e6 * unit, 1e6 * unit);
    EXPECT_EQ(found([&](const Point<2> &x) { return 1e9 * layer((x[0] - origin[0]) / unit); },
                    lattice(20, origin, unit))
                  .size(),
              1u)
        << unit;
  }
}

TEST(UnseenFeatures, of_scenes_are_those_of_their_material_and_coefficient)
{
  const auto warnings = [](const std::string &sections)
  {
    const scene::Scene scene = scene::parse_scene(
        "test.prm", "subsection Domain\n set mesh = squares\nend\nsubsection Methods\n set names = "
                    "FA\nend\n" +
                        sections);
    return unseen_features(scene::make_case(scene, 0, {.1, .3}));
  };
  const auto kernel = [](const std::string &coefficient)
  {
    return "subsection Kernel\n set coefficient = " + coefficient +
           "\nend\nsubsection Problem\n set solution = x\nend\n";
  };
  const auto solid = [](const std::string &E)
  {
    return "subsection Kernel\n set type = 1/r\n set limit = Navier\nend\nsubsection Material\n "
           "set model = LPS\n set nu = 0.25\n set E = " +
           E +
           "\nend\nsubsection Problem\n set load = 0, 0\n set constraint = x, 0\n set local "
           "solution = none\nend\nsubsection Study\n set norms = averages L2\n set decisive "
           "error = averages L2 | own finest level\nend\n";
  };
  EXPECT_TRUE(warnings(kernel("1 + x^2")).empty());
  EXPECT_TRUE(warnings(solid("1")).empty());
  const auto of_kernel = warnings(kernel("abs(x - 0.5) < 0.02 ? 5 : 1")),
             of_solid = warnings(solid("abs(x - 0.5) < 0.02 ? 0.001 : 1"));
  ASSERT_EQ(of_kernel.size(), 1u);
  EXPECT_EQ(of_kernel[0].find("Kernel/coefficient has features between nodes"), 0u) << of_kernel[0];
  ASSERT_EQ(of_solid.size(), 1u);
  EXPECT_EQ(of_solid[0].find("Material/E has features between nodes"), 0u) << of_solid[0];
}
