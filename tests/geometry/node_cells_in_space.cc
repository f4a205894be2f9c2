#include "geometry/node_cells_in_space.h"

#include "base/error.h"
#include "geometry/ball_polyhedron.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <string>

using namespace plumbline;
using namespace plumbline::geometry;

namespace
{
  const Cuboid unit{{0, 0, 0}, {1, 1, 1}};

  CubeLattice box()
  {
    return {{{unit}, {}}, .125};
  }

  /// An L with a hole, away from the origin.
  CubeLattice solid()
  {
    return {{{{{2, -1, 0}, {3, 0, .5}}, {{2, -1, .5}, {2.5, 0, 1}}},
             {{{2.25, -.75, .125}, {2.5, -.5, .375}}}},
            .125};
  }

  double total(const NodeCells<3> &cells, bool is_free)
  {
    const auto middle = cells.area.begin() + static_cast<std::ptrdiff_t>(cells.n_free);
    return is_free ? std::accumulate(cells.area.begin(), middle, 0.)
                   : std::accumulate(middle, cells.area.end(), 0.);
  }

  /// Half a spacing beyond the last node on each side.
  Cuboid layer(const NodeCells<3> &cells, const CubeLattice &omega)
  {
    const double half =
        .5 * omega.h() *
        std::cbrt(static_cast<double>(omega.size()) / static_cast<double>(cells.n_free));
    Cuboid box = omega.cuboid();
    for (const dealii::Point<3> &x : cells.nodes)
      for (unsigned int d = 0; d < 3; ++d)
      {
        box.lower[d] = std::min(box.lower[d], x[d]);
        box.upper[d] = std::max(box.upper[d], x[d]);
      }
    for (unsigned int d = 0; d < 3; ++d)
    {
      box.lower[d] -= half;
      box.upper[d] += half;
    }
    return box;
  }

  double volume(const Cuboid &box)
  {
    const auto sides = box.upper - box.lower;
    return sides[0] * sides[1] * sides[2];
  }

  std::string refusal(const std::vector<dealii::Point<3>> &nodes)
  {
    try
    {
      (void)voronoi_cells(nodes, box(), .2);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }
} // namespace

TEST(VoronoiCellsInSpace, of_centres_are_the_cubes)
{
  for (const CubeLattice &omega : {box(), solid()})
  {
    const NodeCells<3> cells = voronoi_cells(lattice_nodes(omega, 2, 0, 1), omega, .125);
    EXPECT_EQ(cells.n_free, omega.size());
    ASSERT_EQ(cells.pieces.size(), cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      EXPECT_NEAR(cells.area[i] / std::pow(.125, 3), 1, 1e-12);
      EXPECT_LT(cells.centroid[i].distance(cells.nodes[i]), 1e-13);
      EXPECT_EQ(cells.pieces[i].faces().size(), 6u);
    }
  }
}

TEST(VoronoiCellsInSpace, tile_the_domain_and_the_layer)
{
  for (const CubeLattice &omega : {box(), solid()})
    for (const double perturbation : {.1, .3, .49})
    {
      const NodeCells<3> cells =
          voronoi_cells(lattice_nodes(omega, 3, perturbation, 7), omega, .25);
      const double inside = static_cast<double>(omega.size()) * std::pow(.125, 3);
      EXPECT_EQ(cells.n_free, omega.size()) << perturbation;
      EXPECT_NEAR(total(cells, true), inside, 1e-12);
      EXPECT_NEAR(total(cells, false), volume(layer(cells, omega)) - inside, 1e-12);
      for (std::size_t i = 0; i < cells.size(); ++i)
        ASSERT_GT(cells.area[i], 0);
    }
}

// Corners of pieces, too, in which no other node of the same side is nearer.
TEST(VoronoiCellsInSpace, hold_the_points_nearest_to_their_nodes)
{
  const CubeLattice omega = solid();
  const NodeCells<3> cells = voronoi_cells(lattice_nodes(omega, 1, .45, 3), omega, 0);
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    const bool is_free = i < cells.n_free;
    const Cuboid bounds = cells.bounding_box(i);
    for (std::size_t p = cells.first_piece[i]; p < cells.first_piece[i + 1]; ++p)
      for (const auto &x : cells.pieces[p].vertices())
      {
        for (unsigned int d = 0; d < 3; ++d)
          ASSERT_TRUE(x[d] >= bounds.lower[d] && x[d] <= bounds.upper[d]);
        for (std::size_t j = is_free ? 0 : cells.n_free;
             j < (is_free ? cells.n_free : cells.size()); ++j)
          ASSERT_LE(x.distance(cells.nodes[i]), x.distance(cells.nodes[j]) + 1e-12);
      }
  }
}

// Where nodes are nearly those of a lattice, eight cells nearly meet in a point: the faces between
// them are as narrow as nodes are off.
TEST(VoronoiCellsInSpace, may_have_faces_of_any_width)
{
  for (double off = 1e-2; off > 1e-16; off /= 10)
  {
    const NodeCells<3> cells = voronoi_cells(lattice_nodes(box(), 2, off, 5), box(), .125);
    EXPECT_NEAR(total(cells, true), 1, 1e-9) << off;
    const Cuboid frame = layer(cells, box());
    EXPECT_NEAR(total(cells, false), volume(frame) - 1, 1e-9) << off;
    const SolidBall ball{cells.nodes[100], .4};
    double sum = 0;
    for (const ConvexPolyhedron &piece : cells.pieces)
      sum += intersect(ball, piece, 0).volume;
    double beyond = 0; // what the layer does not hold of the ball
    for (unsigned int d = 0; d < 3; ++d)
      for (const double gap : {ball.centre[d] - frame.lower[d], frame.upper[d] - ball.centre[d]})
        if (const double height = ball.radius - gap; height > 0)
          beyond += M_PI * height * height * (3 * ball.radius - height) / 3;
    EXPECT_NEAR(sum + beyond, 4 * M_PI / 3 * std::pow(ball.radius, 3), 1e-9) << off;
  }
}

TEST(VoronoiCellsInSpace, keep_the_order_of_nodes_and_free_ones_first)
{
  const std::vector<dealii::Point<3>> nodes = {
      {-.1, .5, .5}, {.5, .5, .5}, {1.2, .3, .4}, {0, .2, .2}, {.9, .9, .1}};
  const CubeLattice omega({{unit}, {}}, .5);
  const NodeCells<3> cells = voronoi_cells(nodes, omega, .2);
  EXPECT_EQ(cells.n_free, 3u); // one of them on the boundary
  EXPECT_EQ(cells.source, (std::vector<std::size_t>{1, 3, 4, 0, 2}));
  EXPECT_NEAR(total(cells, true), 1, 1e-12);
  EXPECT_NEAR(total(cells, false), volume(layer(cells, omega)) - 1, 1e-12);
}

// What is farther than bonds can be has no part in the layer, however far it is.
TEST(VoronoiCellsInSpace, leave_out_nodes_beyond_the_interaction_domain)
{
  std::vector<dealii::Point<3>> nodes = lattice_nodes(box(), 2, .2, 1);
  const NodeCells<3> cells = voronoi_cells(nodes, box(), .2);
  nodes.insert(nodes.begin(), {1e9, 0, 0});
  nodes.emplace_back(.5, .5, 1.7);
  const NodeCells<3> more = voronoi_cells(nodes, box(), .2);
  EXPECT_EQ(more.size(), cells.size());
  EXPECT_EQ(more.source.front(), cells.source.front() + 1);
  EXPECT_EQ(more.area, cells.area);
}

TEST(VoronoiCellsInSpace, refuse_nodes_that_cannot_be_used)
{
  const std::vector<dealii::Point<3>> nodes = lattice_nodes(box(), 2, .2, 1);
  EXPECT_EQ(refusal(nodes), "");
  const auto expect = [](const std::vector<dealii::Point<3>> &of, const std::string &part)
  { EXPECT_NE(refusal(of).find(part), std::string::npos) << part << " | " << refusal(of); };
  const auto with = [&](const dealii::Point<3> &x)
  {
    auto more = nodes;
    more.push_back(x);
    return more;
  };
  const auto where = [&](const auto &is_kept)
  {
    std::vector<dealii::Point<3>> some;
    std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(some), is_kept);
    return some;
  };
  expect(with(nodes[40]), "lies where node 40 is");
  expect(with({0, 0, std::numeric_limits<double>::quiet_NaN()}), "not finite");
  expect(lattice_nodes(box(), 0, .2, 1), "lies in the interaction domain");
  expect({{-.1, .5, .5}}, "lies in the domain");
  expect(where([](const auto &x) { return x[1] < 1; }), "nodes end at y");
  for (const double factor : {1000., 4.}) // few nodes are in the domain then, or none
  {
    auto other_unit = nodes;
    for (auto &x : other_unit)
      x *= factor;
    expect(other_unit, "in the same unit?");
  }
  // no nodes about one edge
  expect(where([](const auto &x) { return x[0] < 1 || x[1] < .5; }), "add nodes there");
}

TEST(VoronoiCellsInSpace, need_nodes_in_cavities)
{
  const CubeLattice hollow({{unit}, {{{.25, .25, .25}, {.75, .75, .75}}}}, .125);
  auto nodes = lattice_nodes(hollow, 2, .2, 1);
  EXPECT_NO_THROW(voronoi_cells(nodes, hollow, .25));
  nodes.erase(std::remove_if(nodes.begin(), nodes.end(),
                             [&](const dealii::Point<3> &x) {
                               return x[0] > .25 && x[0] < .75 && x[1] > .25 && x[1] < .75 &&
                                      x[2] > .25 && x[2] < .75;
                             }),
              nodes.end());
  EXPECT_THROW(voronoi_cells(nodes, hollow, .25), InputError);
}
