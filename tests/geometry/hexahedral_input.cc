// Hexahedra from gmsh files: what is read, what is refused, and how they are cut.
#include "base/error.h"
#include "geometry/mesh_input.h"
#include "geometry/tetrahedral_check.h"
#include "geometry/tetrahedral_domain.h"
#include "tests/geometry/moved_hexahedra.h"
#include "tests/geometry/tetrahedra_file.h"
#include "tests/text_folder.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::geometry;

namespace
{
  using Place = dealii::Point<3>;

  const CubeLattice cube({{{{0, 0, 0}, {1, 1, 1}}}, {}}, .5);

  class HexahedraFile : public testing::Test
  {
  protected:
    TetrahedralMesh read(const std::string &text)
    {
      return read_tetrahedra(folder_.write("body.msh", text), .5, .5);
    }
    void expect_fault(const std::string &text, const std::string &words)
    {
      std::string fault;
      try
      {
        (void)read(text);
      }
      catch (const InputError &error)
      {
        fault = error.what();
      }
      EXPECT_NE(fault.find(words), std::string::npos) << words << "\nis not in\n" << fault;
      EXPECT_NE(fault.find("body.msh"), std::string::npos) << fault;
    }

    const tests::TextFolder folder_{"hexahedra_file"};
  };

  double volume_of_all(const TetrahedralMesh &mesh)
  {
    double sum = 0;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      sum += determinant(mesh, cell) / 6;
    return sum;
  }

  // two unit cubes, the upper one in Ω
  const std::string nodes = "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 "
                            "1\n9 0 0 -1\n10 1 0 -1\n11 1 1 -1\n12 0 1 -1\n",
                    upper = "1 5 2 1 1 1 2 3 4 5 6 7 8\n", lower = "2 5 2 2 2 9 10 11 12 1 2 3 4\n";

  std::string msh(const std::string &given_nodes, const std::string &elements)
  {
    return tests::msh_22(tests::volume_names, given_nodes, elements);
  }
} // namespace

TEST_F(HexahedraFile, are_cut_into_tetrahedra_that_fill_them)
{
  const TetrahedralMesh given = tests::moved_hexahedra(cube, 1, .1),
                        mesh = read(tests::msh_22(given));
  ASSERT_EQ(mesh.hexahedra.size(), 64u);
  ASSERT_EQ(mesh.cells.size(), 6 * 64u);
  EXPECT_NEAR(volume_of_all(mesh), volume_of_all(given), 1e-13);
  for (std::size_t k = 0; k < mesh.hexahedra.size(); ++k)
    for (std::size_t part = 0; part < 6; ++part)
    {
      EXPECT_GT(determinant(mesh, 6 * k + part), 0);
      for (const unsigned int vertex : mesh.cells[6 * k + part])
        EXPECT_EQ(std::count(mesh.hexahedra[k].begin(), mesh.hexahedra[k].end(), vertex), 1);
    }
  // as cubes they are those of six_per_cube
  EXPECT_NEAR(volume(read(tests::msh_22(tests::moved_hexahedra(cube, 1, 0)))), 1, 1e-14);
}

TEST_F(HexahedraFile, are_turned_around_where_they_are_inside_out)
{
  const TetrahedralMesh mesh = read(msh(nodes, "1 5 2 1 1 5 6 7 8 1 2 3 4\n" + lower));
  EXPECT_NEAR(volume(mesh), 1, 1e-14);
  EXPECT_GT(Hexahedron(mesh, 0).least_determinant(), 0);
}

TEST_F(HexahedraFile, that_cannot_be_used_are_refused)
{
  EXPECT_EQ(read(msh(nodes, upper + lower)).hexahedra.size(), 2u);
  const auto with = [](const std::string &line, const std::string &other)
  { return std::string(nodes).replace(nodes.find(line), line.size(), other); };
  // a corner pushed through the cube, into a plane, and a face bent inwards
  expect_fault(msh(with("7 1 1 1\n", "7 .2 .2 .2\n"), upper + lower), "hexahedron 0 at (");
  expect_fault(msh(with("7 1 1 1\n", "7 .2 .2 .2\n"), upper + lower), "may be inverted in parts");
  expect_fault(msh(with("8 0 1 1\n", "8 0 0 1\n"), upper + lower),
               "is degenerate, or so distorted");
  expect_fault(msh(nodes, "1 5 2 1 1 1 2 4 3 5 6 7 8\n" + lower), "hexahedron 0 at (");
  expect_fault(msh(nodes + "13 .5 .5 2\n", upper + lower + "3 4 2 1 1 5 6 7 13\n"),
               "has 1 tetrahedra and 2 hexahedra; give cells of one kind");
  expect_fault(msh(nodes, "1 17 2 1 1 1 2 3 4 5 6 7 8 1 1 1 1 1 1 1 1 1 1 1 1\n" + lower),
               "has cells of gmsh's type 17 (hexahedra of higher order); only tetrahedra or "
               "hexahedra of first order are allowed");
  expect_fault(msh(nodes, upper), "has the physical volumes 'omega'; give names");
  expect_fault(msh(nodes, upper + "2 5 2 2 2 9 10 11 12 1 2 3 40\n"), "node 40 of a cell");
}

TEST(Hexahedra, have_coordinates_that_map_back)
{
  const TetrahedralMesh mesh = tests::moved_hexahedra(cube, 1, .1);
  const Hexahedron hexahedron(mesh, 21);
  const Place s(.2, .9, .4), x = hexahedron.at(s);
  EXPECT_LT(hexahedron.place(x).distance(s), 1e-13);
  const auto functions = Hexahedron::values(s);
  const auto slopes = hexahedron.slopes(s);
  double sum = 0;
  dealii::Tensor<1, 3> slope;
  for (unsigned int k = 0; k < 8; ++k)
  {
    const double value = mesh.vertices[mesh.hexahedra[21][k]] * Place(1, 2, 3);
    sum += functions[k] * value;
    slope += value * slopes[k];
  }
  EXPECT_NEAR(sum, x * Place(1, 2, 3), 1e-14);
  EXPECT_LT((slope - Place(1, 2, 3)).norm(), 1e-13);
}

TEST(Hexahedra, are_refined_to_meshes_that_fit_together)
{
  const TetrahedralMesh mesh = tests::moved_hexahedra(cube, 1, .1), fine = refine(mesh);
  EXPECT_EQ(fine.hexahedra.size(), 8 * mesh.hexahedra.size());
  EXPECT_EQ(fine.vertices.size(), 9u * 9 * 9);
  EXPECT_NO_THROW(check_hexahedra(fine));
  EXPECT_NO_THROW(check(fine));
  const TetrahedralMesh of_cubes = refine(tests::moved_hexahedra(cube, 1, 0));
  EXPECT_NEAR(volume(of_cubes), 1, 1e-14);
}

TEST(Hexahedra, have_nodes_at_their_centroids)
{
  const auto nodes_of = centroid_nodes(tests::moved_hexahedra(cube, 1, 0));
  ASSERT_EQ(nodes_of.n_free, 8u);
  ASSERT_EQ(nodes_of.size(), 64u);
  EXPECT_LT(nodes_of.nodes[0].distance(Place(.25, .25, .25)), 1e-15);
  EXPECT_NEAR(nodes_of.area[5], .125, 1e-15);
  EXPECT_EQ(nodes_of.first_piece[1] - nodes_of.first_piece[0], 6u);
}
