#include "geometry/vertex_cells.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace plumbline;
using namespace plumbline::geometry;

namespace
{
  Domain box(double width, double height)
  {
    return {{{Point<2>(0, 0), Point<2>(width, height)}}, {}};
  }
} // namespace

TEST(VertexCells, CutCellsAtTheBoundaryOfABody)
{
  const Lattice body(box(1, .5), .25);
  const auto [mesh, cells] = vertex_cells(body, {{Point<2>(0, 0), Point<2>(.25, .5)}});
  check(*mesh);
  EXPECT_TRUE(mesh->is_quads());
  ASSERT_EQ(cells->size(), 15u); // 5 × 3 vertices
  EXPECT_NEAR(std::accumulate(cells->area.begin(), cells->area.end(), 0.), .5, 1e-15);
  // vertices at x = 0 and at x = .25, whose cell reaches over .25 / 2, share area with the box
  EXPECT_EQ(cells->n_free, 9u);
  for (std::size_t i = 0; i < cells->size(); ++i)
  {
    const Point<2> &x = cells->nodes[i];
    EXPECT_EQ(i<cells->n_free, x[0]> .3) << x;
    const double part = (x[0] == 0 || x[0] == 1 ? .5 : 1) * (x[1] == 0 || x[1] == .5 ? .5 : 1);
    EXPECT_NEAR(cells->area[i], part * .0625, 1e-16) << x;
    EXPECT_EQ(mesh->cells[cells->source[i]].is_inside, i < cells->n_free);
  }
}

TEST(VertexCells, ABoxThatOnlyTouchesACellDoesNotFixIt)
{
  const Lattice body(box(1, .5), .25);
  const auto whole = vertex_cells(body, {{Point<2>(0, 0), Point<2>(.125, .5)}});
  EXPECT_EQ(whole.cells->n_free, 12u); // the next cells begin at .125
}

TEST(VertexCells, BodiesThatCannotStandAreRefused)
{
  const Lattice body(box(1, .5), .25);
  EXPECT_THROW(vertex_cells(body, {}), InputError);
  EXPECT_THROW(vertex_cells(body, {{Point<2>(0, 0), Point<2>(1, .5)}}), InputError);
  const Domain holed{{{Point<2>(0, 0), Point<2>(1, 1)}}, {{Point<2>(.25, .25), Point<2>(.5, .5)}}};
  EXPECT_THROW(vertex_cells(Lattice(holed, .25), {{Point<2>(0, 0), Point<2>(.25, 1)}}), InputError);
}

TEST(VertexSquares, BoundaryVerticesAreData)
{
  const Domain l_shape{{{Point<2>(0, 0), Point<2>(1, 1)}}, {{Point<2>(.5, .5), Point<2>(1, 1)}}};
  const NodeCells cells = vertex_squares(Lattice(l_shape, .25), .5);
  EXPECT_EQ(cells.n_free, 5u); // of 3 × 3 inner ones, less those around the re-entrant corner
  for (std::size_t i = 0; i < cells.size(); ++i)
    EXPECT_NEAR(cells.area[i], .0625, 1e-15);
  // data reach over .5 beyond [0,1]²
  EXPECT_LE(cells.nodes[cells.n_free][0], -.5 + 1e-12);
  EXPECT_EQ(cells.size(), 11u * 11u);
  EXPECT_THROW(vertex_squares(Lattice(box(.25, .25), .25), .5), InputError);
}
