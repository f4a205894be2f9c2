#include "geometry/mesh_input.h"

#include "geometry/gmsh_process.h"
#include "meshes.h"

#include <deal.II/base/exceptions.h>

#include <filesystem>
#include <fstream>

#include <unistd.h>

using namespace plumbline;
using namespace plumbline::geometry;

namespace
{
  /// Files that vanish with the test.
  class MeshFile : public testing::Test
  {
  protected:
    void SetUp() override { std::filesystem::create_directory(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    Mesh read(const std::string &name, const std::string &text, double h = .1, double delta = .3)
    {
      const std::string file = (folder_ / name).string();
      std::ofstream(file) << text;
      return read_mesh(file, h, delta);
    }
    std::string fault_of(const std::string &name, const std::string &text)
    {
      return error_of([&] { read(name, text); });
    }

  private:
    const std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("plumbline_mesh_" + std::to_string(getpid()));
  };

  // two triangles of Ω in [0,1]², a square of collar in [1,2] × [0,1]
  const std::string names = "$PhysicalNames\n2\n2 1 \"Omega\"\n2 2 \"COLLAR right\"\n"
                            "$EndPhysicalNames\n";
  const std::string nodes = "$Nodes\n7\n1 0 0 0\n2 1 0 0\n3 2 0 0\n14 0 1 0\n15 1 1 0\n16 2 1 0\n"
                            "20 5 5 0\n$EndNodes\n"; // the last is not used

  std::string msh_2(const std::string &physical_names, const std::string &vertices,
                    const std::string &elements)
  {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + physical_names + vertices + "$Elements\n" +
           elements + "$EndElements\n";
  }
  const std::string elements = "3\n1 2 2 1 1 1 2 15\n2 2 2 1 1 1 15 14\n3 3 2 2 2 2 3 16 15\n";

  const std::string msh_4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + names +
                            "$Entities\n0 0 2 0\n1 0 0 0 1 1 0 1 1 0\n2 1 0 0 2 1 0 1 2 0\n"
                            "$EndEntities\n"
                            "$Nodes\n1 6 1 6\n2 1 0 6\n1\n2\n3\n4\n5\n6\n"
                            "0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\n$EndNodes\n"
                            "$Elements\n2 3 1 3\n2 1 2 2\n1 1 2 5\n2 1 5 4\n2 2 3 1\n3 2 3 6 5\n"
                            "$EndElements\n";

  /// A disc of radius 1 in a ring of width delta.
  const std::string disc = R"(
    DefineConstant[ h = .1, delta = .3 ];
    Point(1) = {0, 0, 0, h};
    For i In {0 : 3}
      Point(2 + i) = {Cos(i * Pi / 2), Sin(i * Pi / 2), 0, h};
      Point(6 + i) = {(1 + delta) * Cos(i * Pi / 2), (1 + delta) * Sin(i * Pi / 2), 0, h};
    EndFor
    For i In {0 : 3}
      Circle(1 + i) = {2 + i, 1, 2 + (i + 1) % 4};
      Circle(5 + i) = {6 + i, 1, 6 + (i + 1) % 4};
    EndFor
    Curve Loop(1) = {1 : 4};
    Curve Loop(2) = {5 : 8};
    Plane Surface(1) = {1};
    Plane Surface(2) = {2, 1};
    Physical Surface("omega") = {1};
    Physical Surface("collar") = {2};
  )";
} // namespace

// ---- lattices -----------------------------------------------------------------------------------

TEST(LatticeMesh, has_the_squares_within_reach)
{
  const double h = .125;
  for (const double delta : {.125, .3, .5})
    for (const Domain &domain : {unit, l_shape, with_hole})
    {
      const Mesh mesh = lattice_mesh(domain, h, delta, false);
      const Lattice lattice(domain, h);
      std::size_t n_near = 0, n_omega = 0;
      for (int j = -9; j < 17; ++j)
        for (int i = -9; i < 17; ++i)
        {
          double nearest = 1e9;
          for (int l = 0; l < 8; ++l)
            for (int k = 0; k < 8; ++k)
              if (lattice.is_inside(k, l))
                nearest = std::min(nearest, std::hypot(std::max(std::abs(i - k) - 1, 0),
                                                       std::max(std::abs(j - l) - 1, 0)));
          n_near += nearest * h < delta - 1e-9;
          n_omega += lattice.is_inside(i, j);
        }
      EXPECT_EQ(n_inside(mesh), n_omega);
      EXPECT_EQ(mesh.cells.size(), n_near);
      EXPECT_NEAR(area(mesh, true), static_cast<double>(n_omega) * h * h, 1e-14);
      const Mesh halves = lattice_mesh(domain, h, delta, true);
      EXPECT_EQ(halves.cells.size(), 2 * mesh.cells.size());
      EXPECT_EQ(halves.vertices, mesh.vertices);
    }
}

TEST(LatticeMesh, has_no_collar_beyond_a_horizon_that_is_a_multiple_of_h)
{
  for (int m = 1; m < 8; ++m) // 3 · .1 > .3
    EXPECT_NEAR(collar_width(lattice_mesh(unit, .1, m * .1, false)), m * .1, 1e-14);
}

TEST(LatticeMesh, adds_layers_until_a_map_has_made_the_collar_wide_enough)
{
  const auto shrink = [](const Point<2> &x) { return Point<2>(.3 * x[0], x[1]); };
  const Mesh mesh = lattice_mesh(unit, .1, .2, false, shrink);
  EXPECT_GE(collar_width(mesh), .2 * (1 - 1e-10));
  EXPECT_LE(collar_width(mesh), .2 + .03);
  EXPECT_NEAR(area(mesh, true), .3, 1e-14);
  const auto grade = [](const Point<2> &x)
  { return Point<2>(std::copysign(std::pow(std::abs(x[0]), 1.5), x[0]), x[1]); };
  EXPECT_GE(collar_width(lattice_mesh(unit, .1, .2, true, grade)), .2 * (1 - 1e-10));
}

TEST(LatticeMesh, refuses_maps_that_do_not_work)
{
  const auto fault = [](const std::function<Point<2>(const Point<2> &)> &map)
  { return error_of([&] { lattice_mesh(unit, .25, .5, false, map); }); };
  EXPECT_TRUE(says(fault([](const Point<2> &x) { return Point<2>(-x[0], x[1]); }),
                   "the map must leave the squares of the boxes convex and not turn them over, but "
                   "after it: cell 0 at "));
  EXPECT_TRUE(says(fault([](const Point<2> &x) { return Point<2>(x[0], .6 * std::tanh(x[1])); }),
                   "the map keeps the collar from becoming delta = 0.5 wide"));
  EXPECT_TRUE(says(fault([](const Point<2> &x) { return Point<2>(x[0], std::sqrt(x[1])); }),
                   "is not finite"));
}

// ---- deal.II's generators -----------------------------------------------------------------------

TEST(GenerateMesh, refines_until_no_side_is_longer_than_h)
{
  const auto is_inside = [](const Point<2> &x) { return x.norm() < .7; };
  const Mesh mesh = generate_mesh("hyper_ball_balanced", "0, 0 : 1", .2, is_inside);
  EXPECT_TRUE(mesh.is_quads());
  EXPECT_LE(mesh.longest_side(), .2);
  EXPECT_GT(mesh.longest_side(), .1);
  double farthest = 0;
  for (const auto &vertex : mesh.vertices)
    farthest = std::max(farthest, vertex.norm());
  EXPECT_NEAR(farthest, 1, 1e-14);
  EXPECT_NEAR(area(mesh, true) + area(mesh, false), M_PI, .03);
  EXPECT_GT(collar_width(mesh), .1);
  EXPECT_LT(collar_width(mesh), .4);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    EXPECT_NEAR(centroid(view(mesh.polygon(c))).norm(), mesh.cells[c].is_inside ? .35 : .85, .36);
}

TEST(GenerateMesh, says_what_is_wrong)
{
  dealii::deal_II_exceptions::disable_abort_on_exception(); // as the command does
  const auto fault = [](const std::string &generator, const std::string &arguments, double h = .3)
  {
    return error_of(
        [&] { generate_mesh(generator, arguments, h, [](const Point<2> &) { return true; }); });
  };
  EXPECT_EQ(fault("hyper_ball", "0, 0 : 1 : false"), "no error");
  EXPECT_TRUE(says(fault("hyper_blob", "0, 0 : 1"), "is not known: deal.II has no such generator"));
  EXPECT_TRUE(says(fault("hyper_ball", "0, 0 : 1"), "too few or too many arguments"));
  EXPECT_TRUE(says(fault("hyper_ball", "0, 0 : 0 : false"), "degenerate"));
  EXPECT_TRUE(says(fault("hyper_cube_slit", "0 : 1 : false"), "has another vertex"));
  EXPECT_TRUE(
      says(fault("hyper_ball", "0, 0 : 1 : false", 1e-5), "h = 1e-05 makes more than 1e+07 cells"));
  EXPECT_TRUE(says(fault("subdivided_hyper_cube", "4000 : 0 : 1"),
                   "4000 may be a number of cells, of which 0 to 3162 along a side are allowed"));
  for (const auto &[generator, arguments] : // hung deal.II, took all memory, or crashed it
       {std::pair("subdivided_hyper_rectangle", "-1,2 : 0,0 : 1,1 : false"),
        std::pair("hyper_cross", "-1,1 : false"), std::pair("cheese", "-1,2"),
        std::pair("channel_with_cylinder", "0.03 : -1 : 2 : false"),
        std::pair("concentric_hyper_shells", "0,0 : .1 : 1 : -1 : 0 : 8 : false")})
    EXPECT_TRUE(says(fault(generator, arguments),
                     ": -1 may be a number of cells, of which 0 to 3162 along a side"))
        << generator;
  EXPECT_TRUE(says(fault("eccentric_hyper_shell", "0,0 : 5,5 : 1 : 2 : 8"), "out of range"));
  EXPECT_EQ(fault("hyper_cube", "-1 : 1 : false"), "no error");
  EXPECT_EQ(fault("hyper_rectangle", "-2,-1 : -1,1 : false"), "no error");
  EXPECT_EQ(fault("hyper_cube", "0. : 4000. : false", 2000), "no error");
  EXPECT_TRUE(says(fault("hyper_ball", "0, 0 : 1 : false", 0), "must be a positive length"));
}

// ---- gmsh ---------------------------------------------------------------------------------------

TEST_F(MeshFile, of_either_format_is_read_as_it_is)
{
  for (const Mesh &mesh : {read("old.msh", msh_2(names, nodes, elements)), read("new.msh", msh_4)})
  {
    EXPECT_EQ(mesh.vertices.size(), 6u);
    ASSERT_EQ(mesh.cells.size(), 3u);
    EXPECT_EQ(n_inside(mesh), 2u);
    EXPECT_EQ(mesh.polygon(0), (Polygon{{0, 0}, {1, 0}, {1, 1}}));
    EXPECT_EQ(mesh.polygon(1), (Polygon{{0, 0}, {1, 1}, {0, 1}}));
    EXPECT_EQ(mesh.polygon(2), (Polygon{{1, 0}, {2, 0}, {2, 1}, {1, 1}}));
    EXPECT_FALSE(mesh.cells[2].is_inside);
  }
}

TEST_F(MeshFile, seen_from_behind_is_turned_around)
{
  const Mesh mesh = read("behind.msh", msh_2(names, nodes,
                                             "3\n1 2 2 1 1 15 2 1\n2 2 2 1 1 14 15 1\n"
                                             "3 3 2 2 2 15 16 3 2\n"));
  EXPECT_NEAR(area(mesh, true), 1, 1e-15);
  EXPECT_NEAR(area(mesh, false), 1, 1e-15);
}

TEST_F(MeshFile, with_geometry_is_meshed_with_h_and_delta)
{
  for (const double delta : {.3, .5})
    for (const double h : {.2, .4})
    {
      const Mesh mesh = read("disc.geo", disc, h, delta);
      EXPECT_TRUE(mesh.is_triangles());
      EXPECT_NEAR(mesh.longest_side() / h, 1.2, .4);
      EXPECT_NEAR(collar_width(mesh), delta, h * h / 4);
      EXPECT_NEAR(area(mesh, true), M_PI, h * h);
      EXPECT_NEAR(area(mesh, false), M_PI * delta * (2 + delta), h * h);
    }
}

TEST_F(MeshFile, may_be_recombined_to_quadrilaterals)
{
  const Mesh mesh = read("quads.geo", disc + "Recombine Surface {1, 2};", .3, .5);
  EXPECT_FALSE(mesh.is_triangles());
  EXPECT_NEAR(area(mesh, true), M_PI, .1);
}

TEST_F(MeshFile, needs_neither_h_nor_delta)
{
  std::string fixed = disc;
  fixed.replace(fixed.find("DefineConstant"), 37, "size = .4; width = .5;");
  for (std::size_t at; (at = fixed.find(" h}")) != std::string::npos;)
    fixed.replace(at, 3, " size}");
  for (std::size_t at; (at = fixed.find("delta")) != std::string::npos;)
    fixed.replace(at, 5, "width");
  EXPECT_EQ(read("fixed.geo", fixed).vertices, read("disc.geo", disc, .4, .5).vertices);
}

TEST_F(MeshFile, that_cannot_be_used_is_refused)
{
  EXPECT_TRUE(says(error_of([] { read_mesh("no_such_file.msh", 1, 1); }), "cannot be read"));
  EXPECT_TRUE(says(fault_of("mesh.stl", ""), "must end in .msh or .geo"));
  // our words first, gmsh's own behind them
  const auto refused = [&](const std::string &script, const std::string &message)
  { EXPECT_TRUE(says(fault_of("bad.geo", script), message)) << fault_of("bad.geo", script); };
  refused("Point(1) = {0, 0;", "bad.geo', line 1 is refused by gmsh: a syntax error at ';'; mend "
                               "the line, or the end of the one before (gmsh says: syntax error");
  const std::string missing =
      " is refused by gmsh: it names what is not there; mend the name or number, or define it "
      "before (gmsh says: ";
  refused("a = 1;\nb = c;\n", "bad.geo', line 2" + missing + "Unknown variable 'c')");
  refused("\nFoo(1);\n", "bad.geo', line 2" + missing + "Unknown command 'Foo')");
  refused("Line(1) = {1, 2};\n", "bad.geo'" + missing + "Unknown control point 1");
  refused("Point(1) = {0, 0, 0};\nPoint(1) = {1, 0, 0};\n",
          "bad.geo' is refused by gmsh: it gives a number that is in use; give another (gmsh says: "
          "GEO point with tag 1 already exists)");
  refused("Point(1) = {0, 0, 0};\nPoint(2) = {1, 0, 0};\nPoint(3) = {1, 1, 0};\nLine(1) = {1, 2};\n"
          "Line(2) = {2, 3};\nCurve Loop(1) = {1, 2};\nPlane Surface(1) = {1};\n",
          "bad.geo' is refused by gmsh: a boundary is not closed; let each curve of a loop begin "
          "where another ends (gmsh says: The 1D mesh");
  refused(
      "Error(\"of a user\");\n",
      "bad.geo' is refused by gmsh: gmsh cannot do what it says; mend it (gmsh says: of a user)");
  for (const std::string unfinished :
       {"If (1)\n a = 1;\n", "For i In {1:3}\n", "Physical Surface(\"omega\") = {1};\n"})
    refused(unfinished, "bad.geo': gmsh makes no cells of it; end every If by EndIf");
  EXPECT_TRUE(says(fault_of("exit.geo", disc + "Exit;"), "without a mesh; take Exit out"));
  EXPECT_TRUE(says(error_of([&] { read("h.geo", disc, 0); }), "h = 0 and delta = 0.3 must be"));
  EXPECT_TRUE(says(fault_of("call.geo", "SystemCall 'true';"), "would start a program"));

  EXPECT_TRUE(
      says(fault_of("nameless.msh", msh_2("", nodes, elements)), "number 1, number 2; give"));
  EXPECT_TRUE(says(fault_of("other.msh", msh_2("$PhysicalNames\n2\n2 1 \"omega\"\n2 2 \"hull\"\n"
                                               "$EndPhysicalNames\n",
                                               nodes, elements)),
                   "'omega', 'hull'; give names that begin with 'omega' and 'collar'"));
  EXPECT_TRUE(says(fault_of("empty.geo", "Point(1) = {0, 0, 0, 1};"), "(none)"));
}

TEST_F(MeshFile, with_cells_that_cannot_be_used_is_refused)
{
  EXPECT_TRUE(says(fault_of("second.geo", disc + "Mesh.ElementOrder = 2;"), "of first order"));
  std::string lifted = nodes;
  lifted.replace(lifted.find("16 2 1 0"), 8, "16 2 1 1");
  EXPECT_TRUE(says(fault_of("lifted.msh", msh_2(names, lifted, elements)), "reaches z = 1"));
}

TEST_F(MeshFile, of_a_script_that_is_far_larger_than_h_is_refused_before_it_is_meshed)
{
  const std::string fault = error_of([&] { read("large.geo", disc, 1e-4); });
  EXPECT_TRUE(says(fault, "large.geo': its geometry is 2.6 by 2.6, more than 5e+07 squares"))
      << fault;
  EXPECT_TRUE(says(fault, "same unit of length")) << fault;
}

TEST_F(MeshFile, with_clockwise_cells_among_others_has_them_turned)
{
  // every second triangle, the quadrilateral, all of them
  for (const std::string cells : {"3\n1 2 2 1 1 1 2 15\n2 2 2 1 1 15 1 14\n3 3 2 2 2 2 3 16 15\n",
                                  "3\n1 2 2 1 1 1 2 15\n2 2 2 1 1 1 15 14\n3 3 2 2 2 2 15 16 3\n",
                                  "3\n1 2 2 1 1 1 15 2\n2 2 2 1 1 15 1 14\n3 3 2 2 2 2 15 16 3\n"})
  {
    const Mesh mesh = read("turned.msh", msh_2(names, nodes, cells));
    ASSERT_EQ(mesh.cells.size(), 3u);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(area(mesh.polygon(c)), c < 2 ? .5 : 1, 1e-15) << cells;
  }
}

// whatever is broken has its line, and the file's reader is ours
TEST_F(MeshFile, that_is_broken_is_refused_by_line)
{
  const auto fault = [&](const std::string &text) { return fault_of("bad.msh", text); };
  EXPECT_TRUE(says(fault(""), "bad.msh', line 1: does not begin with $MeshFormat"));
  EXPECT_TRUE(says(fault("nonsense"), "line 1: does not begin with $MeshFormat"));
  EXPECT_TRUE(says(fault("$MeshFormat\n5 0 8\n"), "line 2: the format's version is none of 2.2"));
  EXPECT_TRUE(says(fault("$MeshFormat\nx 0 8\n"),
                   "line 2: 'x' stands where there must be the version of the format, a finite "
                   "number; mend the file, or export it again"));
  const std::string good = msh_2(names, nodes, elements);
  for (std::size_t size = 0; size < good.size() - 1; size += 7) // cut off anywhere
    EXPECT_TRUE(says(fault(good.substr(0, size)), "bad.msh', line ")) << size;
  EXPECT_TRUE(says(fault(good.substr(0, good.find("$Elements"))), "ends without $Elements"));
  EXPECT_TRUE(says(fault(msh_2(names, "", elements)), "node 1 of a cell is none of $Nodes"));
  const auto changed = [&](std::string text, const std::string &from, const std::string &to)
  { return fault(text.replace(text.find(from), from.size(), to)); };
  EXPECT_TRUE(says(changed(good, "$Nodes\n7", "$Nodes\n8"),
                   "line 18: '$EndNodes' stands where there must be a node's number"));
  EXPECT_TRUE(says(changed(good, "$Nodes\n7", "$Nodes\n6"), "$Nodes, begun in line 9, holds more"));
  EXPECT_TRUE(says(changed(good, "$Nodes\n7", "$Nodes\n99999999999999"), "the number of nodes"));
  EXPECT_TRUE(says(changed(good, "20 5 5 0", "16 5 5 0"), "line 17: node 16 is given twice"));
  EXPECT_TRUE(says(changed(good, "2 1 0 0", "2 nan 0 0"), "line 12: 'nan' stands where"));
  EXPECT_TRUE(says(changed(good, "2 1 0 0", "2 1e400 0 0"), "line 12: '1e400' stands where"));
  EXPECT_TRUE(says(changed(good, "1 2 15", "1 2 17"), "node 17 of a cell is none of $Nodes"));
  EXPECT_TRUE(says(changed(good, "\"Omega\"", "\"Omega"), "line 6: the quotes of a physical"));
  EXPECT_TRUE(
      says(changed(good, "$Nodes", "nodes"), "line 9: text stands outside of the sections"));
  EXPECT_TRUE(
      says(changed(msh_4, "2 1 2 2\n1 1", "2 1 2 3\n1 1"), "line 37: '$EndElements' stands"));
  EXPECT_TRUE(says(changed(msh_4, "1 1 0 1 1 0\n2 1", "1 1 0 2 1 2 0\n2 1"),
                   "surface 1 is in 2 physical surfaces; let it be in one of them"));
  EXPECT_TRUE(says(changed(msh_4, "$Entities", "$Others"), "ends within $Others, begun in line 9"));
}

TEST_F(MeshFile, of_other_formats_is_converted_by_gmsh)
{
  const std::string three = "$MeshFormat\n4 0 8\n$EndMeshFormat\n" + names +
                            "$Entities\n0 0 2 0\n1 0 0 0 1 1 0 1 1 0\n2 1 0 0 2 1 0 1 2 0\n"
                            "$EndEntities\n$Nodes\n1 6\n2 2 0 6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n"
                            "4 0 1 0\n5 1 1 0\n6 2 1 0\n$EndNodes\n$Elements\n2 3\n1 2 2 2\n"
                            "1 1 2 5\n2 1 5 4\n2 2 3 1\n3 2 3 6 5\n$EndElements\n";
  const Mesh mesh = read("three.msh", three);
  EXPECT_EQ(mesh.cells.size(), 3u);
  EXPECT_EQ(n_inside(mesh), 2u);
  EXPECT_TRUE(says(fault_of("cut.msh", three.substr(0, three.size() / 2)), "cut.msh'"));
  EXPECT_TRUE(says(fault_of("binary.msh", "$MeshFormat\n4.1 1 8\nxyz"), "binary.msh'"));
}

// an endless loop, and one that takes all memory
TEST_F(MeshFile, whose_script_does_not_end_is_ended)
{
  const std::string forever = (std::filesystem::path(testing::TempDir()) / "forever.geo").string();
  std::ofstream(forever) << "For i In {0 : 1e12}\n a = i;\nEndFor\n";
  GmshLimits limits;
  limits.seconds = 1;
  EXPECT_TRUE(
      says(error_of([&] { mesh_by_gmsh(forever, .1, .1, limits, "mesh file 'forever.geo'"); }),
           "mesh file 'forever.geo': gmsh was ended after 1 CPU seconds; mend a loop that "
           "does not end"));
  limits.seconds = 60; // so that it is memory that ends the next one, on a busy machine too
  limits.gibibytes = .5;
  const std::string large = (std::filesystem::path(testing::TempDir()) / "large.geo").string();
  std::ofstream(large) << "x() = {0 : 1e9};\n";
  EXPECT_TRUE(says(error_of([&] { mesh_by_gmsh(large, .1, .1, limits, "mesh file 'large.geo'"); }),
                   "GiB of memory; mend the file, choose a larger h"));
  std::filesystem::remove(forever);
  std::filesystem::remove(large);
}

TEST_F(MeshFile, is_meshed_as_h_delta_and_the_text_ask)
{
  const Mesh coarse = read("disc.geo", disc, .4), fine = read("disc.geo", disc, .2);
  EXPECT_EQ(read("disc.geo", disc, .4).vertices, coarse.vertices);
  EXPECT_GT(fine.cells.size(), coarse.cells.size());
  EXPECT_GT(area(read("disc.geo", disc, .4, .6), false), area(coarse, false)); // another delta
  std::string other = disc; // another text under the same name
  other.replace(other.find("(1 + delta) * Cos"), 1, "(");
  EXPECT_NE(read("disc.geo", other + "\n// changed", .4).vertices.size(), 0u);
}

TEST(GmshLimits, come_from_the_environment)
{
  setenv("PLUMBLINE_GMSH_SECONDS", "7.5", 1);
  EXPECT_EQ(GmshLimits::from_environment().seconds, 7.5);
  for (const char *bad : {"", "x", "0", "-1", "nan", "1e9", "1 s"})
  {
    setenv("PLUMBLINE_GMSH_SECONDS", bad, 1);
    EXPECT_TRUE(
        says(error_of([] { GmshLimits::from_environment(); }),
             "PLUMBLINE_GMSH_SECONDS = '" + std::string(bad) + "' is not a positive number"));
  }
  unsetenv("PLUMBLINE_GMSH_SECONDS");
  EXPECT_EQ(GmshLimits::from_environment().seconds, GmshLimits().seconds);
}
