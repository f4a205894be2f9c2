#include "geometry/mesh.h"

#include "meshes.h"

#include <limits>

using namespace plumbline;
using namespace plumbline::geometry;

namespace
{
  /// Two triangles of Ω in [0,1]², a square of collar in [1,2] × [0,1].
  Mesh small_mesh()
  {
    return {{{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}},
            {{{0, 1, 4}, 3, true}, {{0, 4, 3}, 3, true}, {{1, 2, 5, 4}, 4, false}},
            {},
            {}};
  }

  std::string fault(const Mesh &mesh)
  {
    return error_of([&] { check(mesh); });
  }
} // namespace

// ---- check --------------------------------------------------------------------------------------

TEST(MeshCheck, passes_sound_meshes)
{
  EXPECT_EQ(fault(small_mesh()), "no error");
  EXPECT_EQ(fault(lattice_mesh(l_shape, .125, .25, true)), "no error");
}

TEST(MeshCheck, names_inverted_degenerate_and_non_convex_cells_and_their_place)
{
  Mesh mesh = small_mesh();
  std::swap(mesh.cells[1].vertex[0], mesh.cells[1].vertex[1]);
  EXPECT_EQ(fault(mesh), "cell 1 at (0.333333, 0.666667) is inverted; number its vertices "
                         "counter-clockwise");
  mesh = small_mesh();
  mesh.vertices[3] = {.5, .5};
  EXPECT_EQ(fault(mesh),
            "cell 1 at (0.5, 0.5) is degenerate, its area is zero; take it out or move "
            "its vertices apart");
  mesh = small_mesh();
  mesh.vertices[2] = {1.25, .75};
  EXPECT_TRUE(says(fault(mesh), "cell 2 at (1.3125, 0.6875) is not convex"));
  mesh.vertices[2] = {1.5, .5}; // a straight angle
  EXPECT_TRUE(says(fault(mesh), "cell 2 at (1.375, 0.625) is not convex"));
  mesh = small_mesh();
  std::swap(mesh.cells[2].vertex[2], mesh.cells[2].vertex[3]); // a bow tie, its area is zero
  EXPECT_TRUE(says(fault(mesh), "cell 2 at (1.5, 0.5) is degenerate"));
  mesh.vertices[5] = {1.8, 3};
  EXPECT_TRUE(says(fault(mesh), "cell 2 at (1.45, 1) is not convex"));
}

TEST(MeshCheck, names_vertices_that_are_not_finite)
{
  Mesh mesh = small_mesh();
  mesh.vertices[5][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fault(mesh), "vertex 5 at (2, nan) is not finite; give finite coordinates");
}

TEST(MeshCheck, wants_cells_in_the_domain)
{
  Mesh mesh = small_mesh();
  for (MeshCell &cell : mesh.cells)
    cell.is_inside = false;
  EXPECT_TRUE(says(fault(mesh), "none of the 3 cells"));
}

TEST(MeshCheck, finds_hanging_vertices_and_two_in_one_place)
{
  Mesh mesh = small_mesh();
  mesh.vertices.push_back({1, .5});
  mesh.cells[0] = {{0, 1, 6}, 3, true};
  mesh.cells.push_back({{0, 6, 4}, 3, true});
  EXPECT_EQ(fault(mesh), "vertex 6 of cell 0 at (1, 0.5) lies inside a side of cell 2 (a hanging "
                         "vertex); make the mesh conforming");
  mesh = small_mesh();
  for (const double gap : {0., 1e-9}) // at the end of a side, and in one corner only
  {
    mesh.vertices.push_back({1 + gap, 1});
    mesh.cells[2].vertex[3] = static_cast<unsigned int>(mesh.vertices.size() - 1);
    EXPECT_TRUE(says(fault(mesh),
                     "at (1, 1) lies where cell 0 has another vertex; let the cells share "
                     "one"));
  }
  mesh = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1, 1}, {2, 1}, {2, 2}, {1, 2}},
          {{{0, 1, 2, 3}, 4, true}, {{4, 5, 6, 7}, 4, false}},
          {},
          {}};
  EXPECT_TRUE(says(fault(mesh), "at (1, 1) lies where cell 0 has another vertex"));
}

TEST(MeshCheck, finds_cells_given_twice_and_cells_that_overlap)
{
  Mesh mesh = small_mesh();
  mesh.cells.push_back(mesh.cells[0]);
  EXPECT_TRUE(says(fault(mesh),
                   "a side of cell 0, cell 1 and cell 3 at (1, 1) belongs to more than "
                   "two cells"));
  mesh = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {.5, .5}, {1.5, .5}, {1.5, 1.5}, {.5, 1.5}},
          {{{0, 1, 2, 3}, 4, true}, {{4, 5, 6, 7}, 4, false}},
          {},
          {}};
  EXPECT_EQ(fault(mesh), "cells 0 and 1 at (0.75, 0.75) overlap; take one out or move their "
                         "vertices");
  mesh = small_mesh(); // folded over a side
  mesh.cells[2] = {{1, 5, 4}, 3, false};
  mesh.vertices[5] = {.75, .5};
  EXPECT_TRUE(says(fault(mesh), "inverted"));
  mesh.cells[2] = {{1, 4, 5}, 3, false};
  EXPECT_TRUE(says(fault(mesh), "cells 0 and 2 at (0.916667, 0.5) overlap"));
}

// ---- what a mesh knows --------------------------------------------------------------------------

TEST(Mesh, knows_its_cells)
{
  const Mesh mesh = small_mesh();
  EXPECT_FALSE(mesh.is_triangles() || mesh.is_quads());
  EXPECT_DOUBLE_EQ(mesh.longest_side(), std::sqrt(2.));
  EXPECT_EQ(mesh.polygon(2), (Polygon{{1, 0}, {2, 0}, {2, 1}, {1, 1}}));
  EXPECT_EQ(bounding_box(mesh).upper, Point<2>(1, 1));
  EXPECT_TRUE(lattice_mesh(unit, .5, .5, true).is_triangles());
  EXPECT_TRUE(lattice_mesh(unit, .5, .5, false).is_quads());
}

TEST(CollarWidth, is_the_distance_to_the_outside)
{
  for (const double delta : {.1, .25, .3, .7})
    for (const Domain &domain : {unit, l_shape, with_hole})
    {
      // the collar ends with whole squares, which may be farther away than delta
      const double width = collar_width(lattice_mesh(domain, .125, delta, false));
      EXPECT_GE(width, delta - 1e-15);
      EXPECT_LE(width, std::ceil(delta / .125) * .125 + 1e-15);
    }
  // the corners decide: the square (2,2) squares away from that of Ω is √8 h away, (1,3) √10 h
  EXPECT_NEAR(collar_width(lattice_mesh(unit, 1, std::sqrt(8.), false)), std::sqrt(8.), 1e-14);
  EXPECT_NEAR(collar_width(lattice_mesh(unit, 1, std::sqrt(8.) + .01, false)), 3, 1e-14);
}

TEST(CollarWidth, is_to_the_inside_of_a_side_where_that_is_nearest)
{
  // a diamond in a square: its tips point at the middles of the square's sides
  Mesh mesh;
  mesh.vertices = {{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}, {2, 2}, {-2, 2}, {-2, -2}, {2, -2}};
  for (unsigned int k = 0; k < 4; ++k)
  {
    const unsigned int tip = 1 + k, next = 1 + (k + 1) % 4, corner = 5 + k,
                       before = 5 + (k + 3) % 4;
    mesh.cells.push_back({{0, tip, next, 0}, 3, true});
    mesh.cells.push_back({{tip, corner, next, 0}, 3, false});
    mesh.cells.push_back({{tip, before, corner, 0}, 3, false});
  }
  check(mesh);
  EXPECT_NEAR(collar_width(mesh), 1, 1e-15);
}

TEST(CollarWidth, is_zero_where_the_domain_touches_the_outside)
{
  EXPECT_EQ(collar_width(small_mesh()), 0);
  Mesh mesh = lattice_mesh(unit, 1, 1, false);
  ASSERT_EQ(mesh.cells.size(), 9u);
  EXPECT_EQ(collar_width(mesh), 1);
  mesh.cells.erase(mesh.cells.begin()); // touches in a corner
  EXPECT_EQ(collar_width(mesh), 0);
}

TEST(Refine, keeps_shape_and_halves_sides)
{
  for (const Mesh &mesh : {small_mesh(), lattice_mesh(l_shape, .25, .25, true,
                                                      [](const Point<2> &x) {
                                                        return Point<2>(x[0] + x[1] * x[1], x[1]);
                                                      })})
  {
    const Mesh fine = refine(mesh);
    check(fine);
    EXPECT_EQ(fine.cells.size(), 4 * mesh.cells.size());
    EXPECT_EQ(n_inside(fine), 4 * n_inside(mesh));
    EXPECT_NEAR(area(fine, true), area(mesh, true), 1e-14);
    EXPECT_NEAR(area(fine, false), area(mesh, false), 1e-14);
    EXPECT_NEAR(collar_width(fine), collar_width(mesh), 1e-15);
    EXPECT_NEAR(fine.longest_side(), mesh.longest_side() / 2, 1e-15);
    for (std::size_t c = 0; c < fine.cells.size(); ++c)
      EXPECT_TRUE(contains(view(mesh.polygon(c / 4)), centroid(view(fine.polygon(c)))));
  }
}

TEST(Refine, keeps_the_material_of_each_cell)
{
  for (Mesh mesh : {small_mesh(), lattice_mesh(l_shape, .25, .25, true)})
  {
    mesh.groups = {"soft", "stiff", "rigid"};
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      mesh.cells[c].group = c % 3;
    const Mesh fine = refine(mesh);
    EXPECT_EQ(fine.groups, mesh.groups);
    for (std::size_t c = 0; c < fine.cells.size(); ++c)
      EXPECT_EQ(fine.cells[c].group, c / 4 % 3) << c;
  }
}
