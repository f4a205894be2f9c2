#include "geometry/cell_sides.h"

#include "geometry/mesh_input.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::geometry;

namespace
{
  double length(const CellSide &side)
  {
    return side.ends[0].distance(side.ends[1]);
  }
} // namespace

TEST(CellSides, of_squares_are_theirs)
{
  const Mesh mesh = lattice_mesh({{{{0, 0}, {1, .75}}}, {}}, .25, 0, false);
  const NodeCells<2> cells = voronoi_cells(centroids(mesh), mesh);
  const std::vector<CellSide> sides = shared_sides(cells);
  EXPECT_EQ(sides.size(), 3u * 3 + 4 * 2);
  for (const CellSide &side : sides)
  {
    const auto &a = cells.nodes[side.nodes[0]], &b = cells.nodes[side.nodes[1]];
    EXPECT_LT(side.nodes[0], side.nodes[1]);
    EXPECT_NEAR(length(side), .25, 1e-12);
    EXPECT_NEAR((side.ends[0] + .5 * (side.ends[1] - side.ends[0])).distance(a + .5 * (b - a)), 0,
                1e-12);
  }
}

// A cell is made of the triangles between its node and its sides; an L-shaped body, whose boundary
// cuts cells into pieces.
TEST(CellSides, close_the_cells_inside_the_body)
{
  const Mesh mesh = lattice_mesh({{{{0, 0}, {1, 1}}}, {{{.5, .5}, {1, 1}}}}, .125, 0, true);
  const NodeCells<2> cells = voronoi_cells(lattice_nodes(mesh, .125, .35, 3), mesh);
  std::vector<double> area(cells.size());
  std::vector<dealii::Tensor<1, 2>> normals(cells.size());
  for (const CellSide &side : shared_sides(cells))
    for (const int sign : {1, -1})
    {
      const unsigned int i = side.nodes[sign > 0 ? 0 : 1];
      const dealii::Tensor<1, 2> xi =
          sign * (cells.nodes[side.nodes[1]] - cells.nodes[side.nodes[0]]);
      area[i] += .25 * length(side) * xi.norm();
      normals[i] += length(side) / xi.norm() * xi;
    }
  std::size_t n_inside = 0;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    const auto inside = [](double x) { return x > .25 && x < .75; };
    EXPECT_LT(area[i], cells.area[i] * (1 + 1e-6)); // the boundary has the rest
    if (const auto &x = cells.nodes[i];
        (inside(x[0]) && x[1] < .3 && x[1] > .2) || (inside(x[1]) && x[0] < .3 && x[0] > .2))
    {
      ++n_inside;
      EXPECT_NEAR(area[i], cells.area[i], 1e-9 * cells.area[i]);
      EXPECT_NEAR(normals[i].norm(), 0, 1e-9);
    }
  }
  EXPECT_GT(n_inside, 3u);
}
