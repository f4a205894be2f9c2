#include "geometry/vertex_cells.h"

#include "base/error.h"
#include "geometry/mesh_input.h"

#include <gtest/gtest.h>

#include <cmath>
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
  const auto [lattice, cells, mesh] = vertex_cells(body, {{Point<2>(0, 0), Point<2>(.25, .5)}});
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

TEST(VertexCells, OfABodyThatNothingHoldsAreAllFree)
{
  EXPECT_EQ(vertex_cells(Lattice(box(1, .5), .25), {}).cells->n_free, 15u);
}

TEST(VertexCells, OfABoxAreThoseOfItsTriangles)
{
  const double h = .125;
  const std::vector<Box> fixed = {{Point<2>(0, 0), Point<2>(.25, .5)}};
  const VertexCells a = vertex_cells(Lattice(box(1, .5), h), fixed);
  const VertexCells b = vertex_cells(
      std::make_shared<const Mesh>(lattice_mesh(box(1, .5), .0625, 0, true)), {}, h, fixed);
  EXPECT_EQ(a.lattice.n, b.lattice.n);
  EXPECT_EQ(a.cells->source, b.cells->source);
  EXPECT_EQ(a.cells->n_free, b.cells->n_free);
  for (std::size_t i = 0; i < a.cells->size(); ++i)
  {
    EXPECT_LT(a.cells->nodes[i].distance(b.cells->nodes[i]), 1e-14);
    EXPECT_NEAR(a.cells->area[i], b.cells->area[i], 1e-14 * h * h);
    EXPECT_LT(a.cells->centroid[i].distance(b.cells->centroid[i]), 1e-14);
  }
}

TEST(VertexCells, TileABodyOfAnyShape)
{
  Mesh mesh; // a triangle and a quadrilateral on one of its sides
  mesh.vertices = {{.1, .2}, {1.3, .1}, {.7, 1.1}, {1.9, .9}};
  mesh.cells = {{{0, 1, 2, 0}, 3, true}, {{1, 3, 2, 0}, 3, false}};
  double area_of_mesh = 0;
  for (std::size_t c = 0; c < 2; ++c)
    area_of_mesh += area(view(mesh.polygon(c)));
  const auto shared = std::make_shared<const Mesh>(mesh);
  for (const double h : {.5, .13, .031})
  {
    const Point<2> origin(.01, -.02);
    const VertexCells body = vertex_cells(shared, origin, h, {});
    const NodeCells<2> &cells = *body.cells;
    EXPECT_NEAR(std::accumulate(cells.area.begin(), cells.area.end(), 0.), area_of_mesh, 1e-13);
    EXPECT_EQ(cells.n_free, cells.size());
    Point<2> centroid_of_cells;
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      centroid_of_cells += cells.area[i] / area_of_mesh * cells.centroid[i];
      EXPECT_EQ(cells.nodes[i], body.lattice.node(cells.source[i]));
      for (unsigned int d = 0; d < 2; ++d)
      {
        const double steps = (cells.nodes[i][d] - origin[d]) / h;
        EXPECT_NEAR(steps, std::round(steps), 1e-12);
        EXPECT_LT(std::abs(cells.centroid[i][d] - cells.nodes[i][d]), h / 2);
      }
    }
    Point<2> expected;
    for (std::size_t c = 0; c < 2; ++c)
      expected += area(view(mesh.polygon(c))) / area_of_mesh * centroid(view(mesh.polygon(c)));
    EXPECT_LT(centroid_of_cells.distance(expected), 1e-13);
  }
}

TEST(VertexCells, HaveNoNodesForSliversOfRounding)
{
  // .7 = 3.5 × .2 but for rounding: the boundary runs midway between nodes
  const auto mesh = std::make_shared<const Mesh>(
      lattice_mesh(box(.7, .7), .1, 0, false, [](const Point<2> &x) { return x * (1 + 1e-12); }));
  const auto body = vertex_cells(mesh, {}, .2, {});
  EXPECT_EQ(body.cells->size(), 16u);
}

TEST(VertexCells, BodiesThatCannotStandAreRefused)
{
  const Lattice body(box(1, .5), .25);
  EXPECT_THROW(vertex_cells(body, {{Point<2>(2, 0), Point<2>(3, 1)}}), InputError);
  EXPECT_THROW(vertex_cells(body, {{Point<2>(0, 0), Point<2>(1, .5)}}), InputError);
  const std::vector<Box> beside = {{Point<2>(0, 0), Point<2>(.1, .5)},
                                   {Point<2>(0, .6), Point<2>(.5, .7)}};
  EXPECT_THROW(vertex_cells(body, beside), InputError);
  const auto mesh = std::make_shared<const Mesh>(lattice_mesh(box(1, .5), .25, 0, true));
  EXPECT_THROW(vertex_cells(mesh, {}, .25, beside), InputError);
  EXPECT_THROW(vertex_cells(mesh, {}, 0, {}), InputError);
  EXPECT_THROW(vertex_cells(mesh, {}, .25, {{Point<2>(-1, -1), Point<2>(2, 2)}}), InputError);
  const Domain holed{{{Point<2>(0, 0), Point<2>(1, 1)}}, {{Point<2>(.25, .25), Point<2>(.5, .5)}}};
  EXPECT_THROW(vertex_cells(Lattice(holed, .25), {{Point<2>(0, 0), Point<2>(.25, 1)}}), InputError);
}

TEST(VertexSquares, BoundaryVerticesAreData)
{
  const Domain l_shape{{{Point<2>(0, 0), Point<2>(1, 1)}}, {{Point<2>(.5, .5), Point<2>(1, 1)}}};
  const NodeCells<2> cells = vertex_squares(Lattice(l_shape, .25), .5);
  EXPECT_EQ(cells.n_free, 5u); // of 3 × 3 inner ones, less those around the re-entrant corner
  for (std::size_t i = 0; i < cells.size(); ++i)
    EXPECT_NEAR(cells.area[i], .0625, 1e-15);
  // data reach over .5 beyond [0,1]²
  EXPECT_LE(cells.nodes[cells.n_free][0], -.5 + 1e-12);
  EXPECT_EQ(cells.size(), 11u * 11u);
  EXPECT_THROW(vertex_squares(Lattice(box(.25, .25), .25), .5), InputError);
}
