// Tetrahedra from gmsh files: what is read, what is refused, and how they are measured and cut.
#include "base/error.h"
#include "geometry/mesh_input.h"
#include "geometry/tetrahedral_check.h"
#include "geometry/tetrahedral_domain.h"
#include "tests/geometry/tetrahedra_file.h"
#include "tests/text_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

using namespace plumbline;
using namespace plumbline::geometry;

namespace
{
  using Place = dealii::Point<3>;

  /// An L of cubes of side 1/2 with layers of cubes around it.
  const CubeLattice l_shape({{{{0, 0, 0}, {1, .5, .5}}, {{0, 0, 0}, {.5, 1, .5}}}, {}}, .5);

  TetrahedralMesh l_mesh(int n_layers = 1)
  {
    return six_per_cube(l_shape, n_layers);
  }

  /// A ball of radius 1 with a layer of width delta.
  const std::string ball = R"(
    SetFactory("OpenCASCADE");
    DefineConstant[ h = 0.5, delta = 0.5 ];
    Sphere(1) = {0, 0, 0, 1};
    Sphere(2) = {0, 0, 0, 1 + delta + h / 4};
    BooleanFragments{ Volume{2}; Delete; }{ Volume{1}; Delete; }
    Physical Volume("Omega ball") = {1};
    Physical Volume("collar") = {2};
    Mesh.MeshSizeMin = h;
    Mesh.MeshSizeMax = h;
    Mesh.OptimizeThreshold = 0.7;
  )";

  class TetrahedraFile : public testing::Test
  {
  protected:
    TetrahedralMesh read(const std::string &name, const std::string &text, double h = .5)
    {
      return read_tetrahedra(folder_.write(name, text), h, .5);
    }
    std::string fault_of(const std::string &name, const std::string &text)
    {
      try
      {
        (void)read(name, text);
      }
      catch (const InputError &error)
      {
        return error.what();
      }
      return "";
    }
    void expect_fault(const std::string &text, const std::string &words)
    {
      const std::string fault = fault_of("body.msh", text);
      EXPECT_NE(fault.find(words), std::string::npos) << words << "\nis not in\n" << fault;
      EXPECT_NE(fault.find("body.msh"), std::string::npos) << fault;
    }

    const tests::TextFolder folder_{"tetrahedra_file"};
  };

  double volume_of_all(const TetrahedralMesh &mesh)
  {
    double sum = 0;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      sum += determinant(mesh, cell) / 6;
    return sum;
  }

  // two tetrahedra on the face (0, 0, 0), (1, 0, 0), (0, 1, 0), that above it in Ω
  const std::string nodes = "1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 0 0 -1\n",
                    upper = "1 4 2 1 1 1 2 3 4\n", lower = "2 4 2 2 2 1 3 2 5\n";
} // namespace

TEST_F(TetrahedraFile, in_both_formats_give_the_same_mesh)
{
  const TetrahedralMesh given = l_mesh();
  for (const std::string &text : {tests::msh_22(given), tests::msh_41(given)})
  {
    const TetrahedralMesh mesh = read("l.msh", text);
    EXPECT_EQ(mesh.vertices.size(), given.vertices.size());
    EXPECT_EQ(mesh.cells.size(), given.cells.size());
    EXPECT_NEAR(volume(mesh), .375, 1e-14);
    EXPECT_NEAR(volume_of_all(mesh), 2 * 2 * 1.5, 1e-13);
  }
}

TEST_F(TetrahedraFile, that_are_binary_are_converted)
{
  const std::string text = folder_.write("text.msh", tests::msh_22(l_mesh())),
                    binary = (folder_.path() / "binary.msh").string();
  ASSERT_EQ(std::system(("gmsh -save -bin -format msh41 -o " + binary + " " + text + " > " +
                         (folder_.path() / "log").string() + " 2>&1")
                            .c_str()),
            0);
  EXPECT_NEAR(volume(read_tetrahedra(binary, .5, .5)), .375, 1e-14);
}

TEST_F(TetrahedraFile, have_inverted_cells_turned_around)
{
  const TetrahedralMesh mesh = read(
      "inverted.msh", tests::msh_22(tests::volume_names, nodes, "1 4 2 1 1 1 3 2 4\n" + lower));
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    EXPECT_GT(determinant(mesh, cell), 0);
}

TEST_F(TetrahedraFile, that_cannot_be_used_are_refused)
{
  const auto msh = [](const std::string &more_nodes, const std::string &elements)
  { return tests::msh_22(tests::volume_names, nodes + more_nodes, elements); };
  EXPECT_EQ(fault_of("body.msh", msh("", upper + lower)), "");
  expect_fault(msh("6 1 1 0\n7 1 0 1\n8 0 1 1\n9 1 1 1\n", "1 5 2 1 1 1 2 6 3 4 7 9 8\n" + lower),
               "has 1 tetrahedra and 1 hexahedra; give cells of one kind (gmsh: Recombine all");
  expect_fault(msh("6 .5 0 0\n", "1 11 2 1 1 1 2 3 4 6 6 6 6 6 6\n" + lower),
               "type 11 (tetrahedra of higher order); only tetrahedra or hexahedra");
  expect_fault(msh("6 1 1 0\n", "1 4 2 1 1 1 2 3 6\n" + lower),
               "cell 0 at (0.5, 0.5, 0) is degenerate, its volume is zero; take it out");
  expect_fault(
      msh("6 0 0 0\n", upper + "2 4 2 2 2 6 3 2 5\n"),
      "vertex 4 of cell 1 at (0, 0, 0) lies where cell 0 has another vertex; let the cells");
  expect_fault(msh("", upper + lower + "3 4 2 2 2 1 3 2 5\n"),
               "belongs to more than two cells; take out cells that are given twice");
  expect_fault(msh("6 .2 .2 .9\n", upper + "2 4 2 2 2 1 2 3 6\n"),
               "cells 0 and 1 at (0.333333, 0.333333, 0) overlap; take one out");
  expect_fault(msh("6 .2 .2 -3\n7 .3 .2 .5\n8 .2 .3 .5\n", upper + "2 4 2 2 2 7 8 6 4\n"),
               "overlap; take one out");
  expect_fault(msh("6 .5 .5 0\n", upper + "2 4 2 2 2 1 6 2 5\n3 4 2 2 2 1 3 6 5\n"),
               "is partly covered by another one, of cell");
  expect_fault(msh("", "1 4 2 1 1 1 2 3 4\n"), "has the physical volumes 'omega'; give names that "
                                               "begin with 'omega' and 'collar'");
  expect_fault(msh("", "1 2 2 1 1 1 2 3\n"), "has the physical volumes (none); give names");
  expect_fault(tests::msh_22("2\n3 1 \"omega\"\n3 2 \"steel\"\n", nodes, upper + lower),
               "'omega', 'steel'; give names");
}

TEST_F(TetrahedraFile, that_cut_a_square_along_its_other_diagonal_are_not_conforming)
{
  // pyramids over the unit square at z = 0, each of two cells: no vertex hangs
  const std::string square = "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 .5 .5 1\n6 .5 .5 -1\n",
                    above = "1 4 2 1 1 1 2 3 5\n2 4 2 1 1 1 3 4 5\n";
  EXPECT_EQ(fault_of("body.msh", tests::msh_22(tests::volume_names, square,
                                               above + "3 4 2 2 2 1 3 2 6\n4 4 2 2 2 1 4 3 6\n")),
            "");
  expect_fault(
      tests::msh_22(tests::volume_names, square, above + "3 4 2 2 2 1 4 2 6\n4 4 2 2 2 2 4 3 6\n"),
      "so that the mesh is not conforming; let cells share whole faces");
}

TEST_F(TetrahedraFile, that_are_scripts_are_meshed_by_gmsh_in_three_dimensions)
{
  const TetrahedralMesh coarse = read("ball.geo", ball), fine = read("ball.geo", ball, .3);
  EXPECT_GT(fine.cells.size(), 2 * coarse.cells.size());
  // polyhedra in the ball, which tend to it
  const double exact = 4 * M_PI / 3;
  EXPECT_LT(volume(coarse), volume(fine));
  EXPECT_LT(volume(fine), exact);
  EXPECT_NEAR(volume(fine), exact, .15);
  EXPECT_NE(fault_of("none.geo", "SetFactory(\"OpenCASCADE\");\nSphere(1) = {0, 0, 0, 1};\n"
                                 "Physical Surface(\"omega\") = {1};\nMesh.MeshSizeMax = 1;\n")
                .find("has the physical volumes (none)"),
            std::string::npos);
  EXPECT_NE(fault_of("large.geo", "SetFactory(\"OpenCASCADE\");\nSphere(1) = {0, 0, 0, 1000};\n"
                                  "Physical Volume(\"omega\") = {1};\n")
                .find("more than 1e+07 cubes of the mesh size h; are both in the same unit"),
            std::string::npos);
}

TEST(TetrahedralMeshes, know_how_wide_their_interaction_domain_is)
{
  EXPECT_NEAR(collar_width(l_mesh(1), 9), .5, 1e-14);
  EXPECT_NEAR(collar_width(l_mesh(2), 9), 1, 1e-14);
  EXPECT_EQ(collar_width(l_mesh(2), .7), .7);
  EXPECT_EQ(collar_width(l_mesh(0), 9), 0);
  // a vertex of the outer boundary above a face, where no vertex of Ω is near
  TetrahedralMesh pushed = l_mesh(1);
  const CubeLattice &cubes = l_shape;
  const Place top(.5, .5, cubes.cuboid().upper[2] + .5);
  double width = 0;
  for (Place &x : pushed.vertices)
    if (x.distance(top) < 1e-9)
    {
      x -= Place(.17, .11, .2);
      width = .3;
    }
  ASSERT_EQ(width, .3);
  EXPECT_NEAR(collar_width(pushed, 9), width, 1e-14);
}

TEST(TetrahedralMeshes, have_the_cubes_that_lie_in_them)
{
  const CubeLattice whole = cubes_within(l_mesh(), .25);
  EXPECT_EQ(whole.size(), 24u); // all of the L
  EXPECT_EQ(whole.mask().size(), 32u);
  EXPECT_FALSE(whole.is_inside({3, 3, 0}));
  // cubes of .3 leave a strip: of 3 x 3 x 1 about the middle those that reach into the notch
  const CubeLattice part = cubes_within(l_mesh(), .3);
  EXPECT_NEAR(part.origin()[0], .05, 1e-14);
  EXPECT_NEAR(part.origin()[2], .1, 1e-14);
  EXPECT_EQ(part.size(), 5u);
  EXPECT_THROW(cubes_within(l_mesh(), .6), InputError);
}

TEST_F(TetrahedraFile, find_the_cells_of_places)
{
  const TetrahedralMesh mesh = read("ball.geo", ball);
  const TetrahedronSearch search(mesh);
  EXPECT_TRUE(search.find({.1, .2, -.3}));
  EXPECT_FALSE(search.find({0, 0, 1.2})); // in the layer around
  EXPECT_FALSE(search.find({0, 0, 9}));
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
  {
    Place centroid;
    for (const unsigned int vertex : mesh.cells[cell])
      centroid += mesh.vertices[vertex] / 4;
    const auto found = search.find(centroid);
    EXPECT_EQ(found.has_value(), mesh.is_inside[cell] != 0);
    if (found)
    {
      EXPECT_EQ(*found, cell);
    }
  }
}

TEST_F(TetrahedraFile, are_cut_into_eight)
{
  const TetrahedralMesh coarse = read("ball.geo", ball), fine = refine(coarse);
  EXPECT_EQ(fine.cells.size(), 8 * coarse.cells.size());
  EXPECT_NO_THROW(check(fine));
  EXPECT_NEAR(volume(fine), volume(coarse), 1e-12);
  for (std::size_t cell = 0; cell < fine.cells.size(); ++cell)
    EXPECT_NEAR(determinant(fine, cell), determinant(coarse, cell / 8) / 8, 1e-14);
}

TEST_F(TetrahedraFile, give_nodes_whose_cells_they_are)
{
  const TetrahedralMesh mesh = read("ball.geo", ball);
  const NodeCells<3> cells = centroid_nodes(mesh);
  ASSERT_EQ(cells.size(), mesh.cells.size());
  double inner = 0, all = 0;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    all += cells.area[i];
    inner += i < cells.n_free ? cells.area[i] : 0;
    EXPECT_EQ(mesh.is_inside[cells.source[i]] != 0, i < cells.n_free);
  }
  EXPECT_NEAR(inner, volume(mesh), 1e-12);
  EXPECT_NEAR(all, volume_of_all(mesh), 1e-11);
}

TEST_F(TetrahedraFile, may_have_their_thinnest_cells_first)
{
  const TetrahedralMesh mesh = read("ball.geo", ball), other = with_thinnest_first(mesh, 3);
  const auto roundness = [](const TetrahedralMesh &one, std::size_t cell)
  {
    double longest = 0;
    for (const unsigned int a : one.cells[cell])
      for (const unsigned int b : one.cells[cell])
        longest = std::max(longest, one.vertices[a].distance(one.vertices[b]));
    return determinant(one, cell) / std::pow(longest, 3);
  };
  EXPECT_NO_THROW(check(other));
  EXPECT_NEAR(volume(other), volume(mesh), 1e-12);
  ASSERT_EQ(other.cells.size(), mesh.cells.size());
  for (std::size_t cell = 3; cell < other.cells.size(); ++cell)
    if (other.is_inside[cell] != 0)
    {
      EXPECT_GE(roundness(other, cell), roundness(other, 2));
    }
  for (std::size_t cell = 0; cell < 3; ++cell)
    for (const unsigned int vertex : other.cells[cell])
      EXPECT_LT(vertex, 12u);
}
