#include "geometry/node_cells.h"

#include "meshes.h"

#include <limits>
#include <random>

using namespace plumbline;
using namespace plumbline::geometry;

namespace
{
  Mesh disc()
  {
    return generate_mesh("hyper_ball_balanced", "0, 0 : 1", .2,
                         [](const Point<2> &x) { return x.norm() < .6; });
  }

  /// Areas add up and agree with the pieces; every piece is nearer to its node than to any other
  /// node of its side.
  void expect_voronoi(const NodeCells<2> &cells, const Mesh &mesh)
  {
    double sum[2] = {0, 0};
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      const bool is_free = i < cells.n_free;
      sum[is_free] += cells.area[i];
      double of_pieces = 0;
      const Box box = cells.bounding_box(i);
      for (std::size_t p = cells.first_piece[i]; p < cells.first_piece[i + 1]; ++p)
      {
        const Polygon &piece = cells.pieces[p];
        of_pieces += area(view(piece));
        // a piece as the geometry of balls wants it
        EXPECT_NEAR(intersect({cells.nodes[i], 100}, view(piece)).area, area(view(piece)), 1e-14);
        for (std::size_t k = 0; k < piece.size(); ++k) // corners and the centroid
        {
          const Point<2> at = k == 0 ? centroid(view(piece)) : piece[k];
          for (std::size_t j = is_free ? 0 : cells.n_free;
               j < (is_free ? cells.n_free : cells.size()); ++j)
            ASSERT_LE(at.distance(cells.nodes[i]), at.distance(cells.nodes[j]) + 1e-14);
          for (unsigned int d = 0; d < 2; ++d)
            ASSERT_TRUE(at[d] >= box.lower[d] && at[d] <= box.upper[d]);
        }
      }
      EXPECT_GT(of_pieces, 0);
      EXPECT_NEAR(cells.area[i], of_pieces, 1e-15);
    }
    EXPECT_NEAR(sum[1], area(mesh, true), 1e-12);
    EXPECT_NEAR(sum[0], area(mesh, false), 1e-12);
  }
} // namespace

TEST(VoronoiCells, of_lattice_nodes_are_the_squares)
{
  for (const Domain &domain : {unit, l_shape, with_hole})
  {
    const Mesh mesh = lattice_mesh(domain, .125, .25, true);
    const NodeCells<2> cells = voronoi_cells(lattice_nodes(mesh, .125, 0, 1), mesh);
    EXPECT_EQ(cells.size(), mesh.cells.size() / 2);
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      EXPECT_NEAR(cells.area[i], .125 * .125, 1e-15);
      EXPECT_NEAR(cells.centroid[i].distance(cells.nodes[i]), 0, 1e-14);
    }
    expect_voronoi(cells, mesh);
  }
}

TEST(VoronoiCells, of_moved_nodes_tile_domain_and_collar)
{
  for (const Domain &domain : {unit, l_shape, with_hole})
    for (const double perturbation : {.1, .49})
    {
      const Mesh mesh = lattice_mesh(domain, .125, .3, false);
      expect_voronoi(voronoi_cells(lattice_nodes(mesh, .125, perturbation, 1), mesh), mesh);
      // nodes that know nothing of the mesh
      const Mesh bent = lattice_mesh(domain, .125, .3, true, bend);
      expect_voronoi(voronoi_cells(lattice_nodes(bent, .09, perturbation, 2), bent), bent);
    }
  const Mesh mesh = disc();
  expect_voronoi(voronoi_cells(centroids(mesh), mesh), mesh);
  expect_voronoi(voronoi_cells(lattice_nodes(mesh, .1, .3, 3), mesh), mesh);
}

TEST(VoronoiCells, that_no_boundary_cuts_are_one_piece)
{
  const Mesh mesh = lattice_mesh(unit, .125, .25, true);
  const NodeCells<2> cells = voronoi_cells(lattice_nodes(mesh, .1, .2, 1), mesh);
  std::size_t n_whole = 0;
  for (std::size_t i = 0; i < cells.n_free; ++i)
  {
    const Box box = cells.bounding_box(i);
    const bool is_cut = std::min(box.lower[0], box.lower[1]) < 1e-9 ||
                        std::max(box.upper[0], box.upper[1]) > 1 - 1e-9;
    const std::size_t n_pieces = cells.first_piece[i + 1] - cells.first_piece[i];
    EXPECT_TRUE(is_cut || n_pieces == 1);
    n_whole += !is_cut;
  }
  EXPECT_GT(n_whole, 50u);
}

TEST(VoronoiCells, keep_order_and_put_the_domain_first)
{
  const Mesh mesh = lattice_mesh(unit, .25, .25, false);
  const std::vector<Point<2>> nodes{
      {-.1, .1}, {.9, .9}, {1, .5}, {1.1, .2}, {.2, .3}}; // 2 is on ∂Ω
  const NodeCells<2> cells = voronoi_cells(nodes, mesh);
  EXPECT_EQ(cells.n_free, 3u);
  EXPECT_EQ(cells.source, (std::vector<std::size_t>{1, 2, 4, 0, 3}));
  for (std::size_t i = 0; i < cells.size(); ++i)
    EXPECT_EQ(cells.nodes[i], nodes[cells.source[i]]);
  expect_voronoi(cells, mesh);
}

TEST(VoronoiCells, of_few_or_collinear_nodes_are_fine)
{
  const Mesh mesh = lattice_mesh(l_shape, .25, .25, false);
  expect_voronoi(voronoi_cells({{.1, .1}, {-.1, .1}}, mesh), mesh);
  expect_voronoi(voronoi_cells({{.1, .1}, {.2, .2}, {.4, .4}, {-.1, .1}, {-.1, .3}}, mesh), mesh);
}

TEST(VoronoiCells, of_nodes_nearly_in_one_place_far_from_the_origin_tile)
{
  const auto shift = [](const Point<2> &x) { return bend(x) + Point<2>(1000, -500); };
  const Mesh mesh = lattice_mesh(l_shape, .25, .25, false, shift);
  std::vector<Point<2>> nodes;
  for (const auto &node : lattice_nodes(mesh, .1, .3, 1))
    nodes.insert(nodes.end(), {node, node + Point<2>(1e-11, 1e-12)});
  const NodeCells<2> cells = voronoi_cells(nodes, mesh);
  double sum = 0;
  for (const double a : cells.area)
    sum += a;
  // to the rounding of coordinates, 1e-13, times the length of all sides
  EXPECT_NEAR(sum, area(mesh, true) + area(mesh, false), 1e-10);
}

TEST(VoronoiCells, of_nodes_on_a_circle_are_sectors)
{
  const Mesh mesh = lattice_mesh({{{{-1, -1}, {1, 1}}}, {}}, .5, .5, false);
  std::vector<Point<2>> nodes{{1.2, 0}};
  for (int k = 0; k < 8; ++k)
    nodes.emplace_back(.5 * std::cos((k + .5) * M_PI / 4), .5 * std::sin((k + .5) * M_PI / 4));
  const NodeCells<2> cells = voronoi_cells(nodes, mesh);
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_NEAR(cells.area[i], .5, 1e-14);
  expect_voronoi(cells, mesh);
}

TEST(VoronoiCells, name_the_node_that_is_wrong)
{
  const Mesh mesh = lattice_mesh(unit, .25, .25, false);
  const auto fault = [&](const std::vector<Point<2>> &nodes)
  { return error_of([&] { voronoi_cells(nodes, mesh); }); };
  EXPECT_TRUE(says(fault({{.5, .5}, {-.1, .1}, {.2, .2}, {.5, .5}}),
                   "node 3 at (0.5, 0.5) lies where node 0 is"));
  EXPECT_TRUE(says(fault({{.5, .5}, {-.1, .1}, {1.5, .2}}),
                   "node 2 at (1.5, 0.2) lies outside of the domain and its collar"));
  EXPECT_TRUE(says(fault({{.5, .5}, {-.1, std::numeric_limits<double>::infinity()}}),
                   "node 1 at (-0.1, inf) is not finite"));
  EXPECT_TRUE(says(fault({{-.1, .5}}), "none of the 1 nodes lies in the domain"));
  EXPECT_TRUE(says(fault({{.1, .5}}), "none of the 1 nodes lies in the collar"));
}

TEST(LatticeNodes, are_the_centres_of_the_squares_of_a_lattice_mesh)
{
  const Mesh mesh = lattice_mesh(with_hole, .125, .1, false);
  const auto nodes = lattice_nodes(mesh, .125, 0, 1), centres = centroids(mesh);
  ASSERT_EQ(nodes.size(), centres.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    EXPECT_NEAR(nodes[i].distance(centres[i]), 0, 1e-15);
}

TEST(LatticeNodes, move_by_a_uniform_share_of_h)
{
  const Mesh mesh = lattice_mesh(unit, .02, .04, false);
  const auto at_rest = lattice_nodes(mesh, .02, 0, 1), moved = lattice_nodes(mesh, .02, .3, 1);
  ASSERT_EQ(moved.size(), at_rest.size());
  double largest = 0, mean = 0, square = 0;
  for (std::size_t i = 0; i < moved.size(); ++i)
    for (unsigned int d = 0; d < 2; ++d)
    {
      const double move = (moved[i][d] - at_rest[i][d]) / .02;
      largest = std::max(largest, std::abs(move));
      mean += move / (2. * moved.size());
      square += move * move / (2. * moved.size());
    }
  EXPECT_LE(largest, .3);
  EXPECT_GT(largest, .299);
  EXPECT_NEAR(mean, 0, .01);
  EXPECT_NEAR(square, .03, .001);
}

TEST(LatticeNodes, are_the_same_for_a_seed_on_every_machine)
{
  const Mesh mesh = lattice_mesh(unit, .5, .5, false);
  const auto nodes = lattice_nodes(mesh, .5, .2, 7);
  EXPECT_EQ(nodes, lattice_nodes(mesh, .5, .2, 7));
  EXPECT_NE(nodes, lattice_nodes(mesh, .5, .2, 8));
  // the first number that a Mersenne twister with the standard's default seed draws
  const double first = lattice_nodes(mesh, .5, .2, 5489)[0][0];
  EXPECT_DOUBLE_EQ(first, -.25 + .1 * (2 * 3499211612. / 4294967296. - 1));
}

TEST(LatticeNodes, stay_on_their_side)
{
  const Mesh mesh = lattice_mesh(l_shape, .25, .5, true, bend);
  const auto at_rest = lattice_nodes(mesh, .1, 0, 1), moved = lattice_nodes(mesh, .1, 3, 1);
  ASSERT_EQ(moved.size(), at_rest.size());
  const NodeCells<2> before = voronoi_cells(at_rest, mesh), after = voronoi_cells(moved, mesh);
  EXPECT_EQ(before.source, after.source);
  EXPECT_EQ(before.n_free, after.n_free);
}

TEST(LatticeNodes, that_would_leave_their_side_go_half_the_way_until_they_do_not)
{
  const Mesh mesh = lattice_mesh(l_shape, .25, .5, true, bend);
  // moves of up to 30 h leave their side nearly always
  const auto at_rest = lattice_nodes(mesh, .1, 0, 1), moved = lattice_nodes(mesh, .1, 30, 1);
  for (std::size_t i = 0; i < moved.size(); ++i)
    EXPECT_GT(moved[i].distance(at_rest[i]), 0) << at_rest[i];
}
