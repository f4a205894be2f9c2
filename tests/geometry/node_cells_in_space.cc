#include "geometry/node_cells_in_space.h"

#include "base/error.h"
#include "geometry/ball_polyhedron.h"

#include <gtest/gtest.h>

#include <cmath>
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

  double volume(const CubeLattice &omega, int n_layers)
  {
    double n = 1;
    for (const int along : omega.n_cells())
      n *= along + 2. * n_layers;
    return n * std::pow(omega.h(), 3);
  }

  std::string refusal(const std::vector<dealii::Point<3>> &nodes)
  {
    try
    {
      (void)voronoi_cells(nodes, box(), 2);
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
    const NodeCells<3> cells = voronoi_cells(lattice_nodes(omega, 2, 0, 1), omega, 2);
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
      const NodeCells<3> cells = voronoi_cells(lattice_nodes(omega, 3, perturbation, 7), omega, 3);
      const double inside = static_cast<double>(omega.size()) * std::pow(.125, 3);
      EXPECT_EQ(cells.n_free, omega.size()) << perturbation;
      EXPECT_NEAR(total(cells, true), inside, 1e-12);
      EXPECT_NEAR(total(cells, false), volume(omega, 3) - inside, 1e-12);
      for (std::size_t i = 0; i < cells.size(); ++i)
        ASSERT_GT(cells.area[i], 0);
    }
}

// Corners of pieces, too, in which no other node of the same side is nearer.
TEST(VoronoiCellsInSpace, hold_the_points_nearest_to_their_nodes)
{
  const CubeLattice omega = solid();
  const NodeCells<3> cells = voronoi_cells(lattice_nodes(omega, 1, .45, 3), omega, 1);
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
    const NodeCells<3> cells = voronoi_cells(lattice_nodes(box(), 2, off, 5), box(), 2);
    EXPECT_NEAR(total(cells, true), 1, 1e-9) << off;
    EXPECT_NEAR(total(cells, false), volume(box(), 2) - 1, 1e-9) << off;
    const SolidBall ball{cells.nodes[100], .4};
    double sum = 0;
    for (const ConvexPolyhedron &piece : cells.pieces)
      sum += intersect(ball, piece, 0).volume;
    double beyond = 0; // what the layer does not hold of the ball
    for (unsigned int d = 0; d < 3; ++d)
      for (const double gap : {ball.centre[d] + .25, 1.25 - ball.centre[d]})
        if (const double height = ball.radius - gap; height > 0)
          beyond += M_PI * height * height * (3 * ball.radius - height) / 3;
    EXPECT_NEAR(sum + beyond, 4 * M_PI / 3 * std::pow(ball.radius, 3), 1e-9) << off;
  }
}

TEST(VoronoiCellsInSpace, keep_the_order_of_nodes_and_free_ones_first)
{
  const std::vector<dealii::Point<3>> nodes = {
      {-.1, .5, .5}, {.5, .5, .5}, {1.2, .3, .4}, {0, .2, .2}, {.9, .9, .1}};
  const NodeCells<3> cells = voronoi_cells(nodes, box(), 2);
  EXPECT_EQ(cells.n_free, 3u); // one of them on the boundary
  EXPECT_EQ(cells.source, (std::vector<std::size_t>{1, 3, 4, 0, 2}));
  EXPECT_NEAR(total(cells, true), 1, 1e-12);
  EXPECT_NEAR(total(cells, false), volume(box(), 2) - 1, 1e-12);
}

TEST(VoronoiCellsInSpace, refuse_nodes_that_cannot_be_used)
{
  std::vector<dealii::Point<3>> nodes = lattice_nodes(box(), 2, .2, 1);
  EXPECT_EQ(refusal(nodes), "");
  const auto with = [&](const dealii::Point<3> &x)
  {
    auto more = nodes;
    more.push_back(x);
    return refusal(more);
  };
  EXPECT_NE(with(nodes[40]).find("lies where node 40 is"), std::string::npos) << with(nodes[40]);
  EXPECT_NE(with({0, 0, 1.3}).find("outside of the domain"), std::string::npos);
  EXPECT_NE(with({0, 0, std::numeric_limits<double>::quiet_NaN()}).find("not finite"),
            std::string::npos);
  EXPECT_NE(refusal({{.5, .5, .5}}).find("lies in the interaction domain"), std::string::npos);
  EXPECT_NE(refusal({{-.1, .5, .5}}).find("lies in the domain"), std::string::npos);
}
