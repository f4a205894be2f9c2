#include "geometry/curved_mesh.h"

#include "geometry/node_cells.h"
#include "meshes.h"

#include <filesystem>
#include <fstream>

#include <unistd.h>

using namespace plumbline;
using namespace plumbline::geometry;

namespace
{
  Point<2> on_circle(double angle, double radius)
  {
    return Point<2>(radius * std::cos(angle), radius * std::sin(angle));
  }

  /// The unit disk in n triangles about its centre, or what is left of the square of side 4 around
  /// it in 2 n; both with the points of the circle at n_inner places of each side.
  struct Round
  {
    Mesh mesh;
    SideCurves curves;
  };
  Round disk(unsigned int n, unsigned int n_inner)
  {
    Round result;
    Mesh &mesh = result.mesh;
    mesh.vertices = {Point<2>()};
    const double step = 2 * M_PI / n, start = .3;
    for (unsigned int k = 0; k < n; ++k)
      mesh.vertices.push_back(on_circle(start + k * step, 1));
    for (unsigned int k = 0; k < n; ++k)
    {
      const unsigned int a = k + 1, b = (k + 1) % n + 1;
      mesh.cells.push_back({{0, a, b, 0}, 3, true});
      std::vector<Point<2>> points;
      for (unsigned int i = 1; i <= n_inner; ++i)
        points.push_back(on_circle(start + (k + i / (n_inner + 1.)) * step, 1));
      if (a > b)
        std::reverse(points.begin(), points.end());
      result.curves[std::minmax(a, b)] = points;
    }
    return result;
  }

  double integral(const Mesh &mesh, const std::function<double(const Point<2> &)> &f)
  {
    double sum = 0;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    {
      const CutRule rule = polygon_rule(view(mesh.polygon(c)), 8);
      for (std::size_t q = 0; q < rule.points.size(); ++q)
        sum += rule.weights[q] * f(rule.points[q]);
    }
    return sum;
  }

  const auto fourth_power = [](const Point<2> &x) { return std::pow(x[0], 4); };
} // namespace

TEST(CurvedMesh, keeps_areas_and_errs_like_the_fourth_power_of_h)
{
  double before = 0;
  for (const unsigned int n : {8u, 16u, 32u, 64u})
  {
    const Round round = disk(n, 3);
    const Mesh bent = follow_curves(round.mesh, round.curves);
    EXPECT_EQ(bent.cells.size(), 4u * n);
    EXPECT_EQ(bent.n_wholes(), n);
    // as far as a polynomial of degree 4 follows the circle
    EXPECT_NEAR(area(bent, true), M_PI, 2e-2 * std::pow(2 * M_PI / n, 6));
    const double error = std::abs(integral(bent, fourth_power) - M_PI / 8);
    if (before > 0)
    {
      EXPECT_NEAR(std::log2(before / error), 4, .2) << n;
      EXPECT_LT(error, 1e-3 * std::abs(integral(round.mesh, fourth_power) - M_PI / 8)) << n;
    }
    before = error;
  }
}

TEST(CurvedMesh, follows_points_of_any_order)
{
  const unsigned int n = 16;
  for (const unsigned int n_inner : {1u, 2u, 3u})
  {
    const Round round = disk(n, n_inner);
    const Mesh bent = follow_curves(round.mesh, round.curves);
    EXPECT_NEAR(area(bent, true), M_PI, 1e-3);
    EXPECT_EQ(bent.cells.size(), 4u * n);
    for (const Point<2> &x : bent.vertices)
      EXPECT_LT(x.norm(), 1 + 2e-3);
  }
}

TEST(CurvedMesh, knows_the_triangles_that_its_cells_are_parts_of)
{
  Round round = disk(8, 3);
  auto &flat = round.curves.begin()->second; // straight after all
  const auto [a, b] = round.curves.begin()->first;
  for (std::size_t k = 0; k < flat.size(); ++k)
    flat[k] =
        round.mesh.vertices[a] + (k + 1) / 4. * (round.mesh.vertices[b] - round.mesh.vertices[a]);
  const Mesh bent = follow_curves(round.mesh, round.curves);
  EXPECT_EQ(bent.cells.size(), 7 * 4 + 1u);
  EXPECT_NO_THROW(check(bent));
  const Mesh straight = straightened(bent);
  ASSERT_EQ(straight.cells.size(), round.mesh.cells.size());
  const auto nodes = centroids(bent);
  ASSERT_EQ(nodes.size(), 8u);
  for (std::size_t c = 0; c < 8; ++c)
  {
    EXPECT_EQ(straight.polygon(c), round.mesh.polygon(c));
    double twice = 0; // the area within the outline
    Point<2> of_parts;
    const auto &outline = bent.wholes[c].outline;
    for (std::size_t k = 0; k < outline.size(); ++k)
    {
      const Point<2> &p = bent.vertices[outline[k]],
                     &q = bent.vertices[outline[(k + 1) % outline.size()]];
      twice += p[0] * q[1] - p[1] * q[0];
    }
    double sum = 0;
    const std::size_t end = c + 1 < 8 ? bent.wholes[c + 1].first_part : bent.cells.size();
    for (std::size_t part = bent.wholes[c].first_part; part < end; ++part)
    {
      const double of_part = area(view(bent.polygon(part)));
      sum += of_part;
      of_parts += of_part * centroid(view(bent.polygon(part)));
    }
    EXPECT_NEAR(sum, twice / 2, 1e-15);
    EXPECT_LT(nodes[c].distance(of_parts / sum), 1e-15);
  }
  EXPECT_TRUE(refine(bent).wholes.empty());
  EXPECT_NEAR(area(refine(bent), true), area(bent, true), 1e-14);
}

TEST(CurvedMesh, has_parts_about_the_middle_of_triangles_with_several_bent_sides)
{
  // a Reuleaux triangle
  Mesh mesh;
  const double side = std::sqrt(3.);
  for (const double angle : {0., 2., 4.})
    mesh.vertices.push_back(on_circle(angle * M_PI / 3, 1));
  mesh.cells = {{{0, 1, 2, 0}, 3, true}};
  SideCurves curves;
  for (const auto &[a, b, across] : {std::array{0u, 1u, 2u}, {1u, 2u, 0u}, {0u, 2u, 1u}})
  {
    const Point<2> &centre = mesh.vertices[across];
    const auto from = mesh.vertices[a] - centre, to = mesh.vertices[b] - centre;
    for (const double t : {.25, .5, .75})
      curves[{a, b}].push_back(centre +
                               (std::sin((1 - t) * M_PI / 3) * from + std::sin(t * M_PI / 3) * to) /
                                   std::sin(M_PI / 3));
  }
  const Mesh bent = follow_curves(mesh, curves);
  EXPECT_EQ(bent.cells.size(), 12u);
  EXPECT_NO_THROW(check(bent));
  constexpr double of_polynomials = 1e-4; // of degree 4 through arcs of 60 degrees
  EXPECT_NEAR(area(bent, true), (M_PI - std::sqrt(3.)) / 2 * side * side, of_polynomials);
}

TEST(CurvedMesh, refuses_what_it_cannot_follow)
{
  Round round = disk(8, 3);
  for (auto &x : round.curves.begin()->second)
    x = Point<2>(-5 * x[0], -5 * x[1]);
  EXPECT_TRUE(says(error_of([&] { follow_curves(round.mesh, round.curves); }),
                   "is bent so much that its triangle cannot follow it; choose a smaller h"));
  const Mesh squares = lattice_mesh(unit, .5, .5, false);
  EXPECT_TRUE(says(error_of([&] { follow_curves(squares, {}); }),
                   "Domain/sides = curved is for triangles"));
}

namespace
{
  /// Written where it vanishes with the test.
  class CurvedFile : public testing::Test
  {
  protected:
    void SetUp() override { std::filesystem::create_directory(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    std::string write(const std::string &name, const std::string &text) const
    {
      const std::string file = (folder_ / name).string();
      std::ofstream(file) << text;
      return file;
    }

  private:
    const std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("plumbline_curved_" + std::to_string(getpid()));
  };

  const std::string ring = "DefineConstant[ h = .1, delta = .3 ];\n"
                           "Point(1) = {0, 0, 0, h};\n"
                           "For k In {0:3}\n"
                           "  Point(2 + k) = {Cos(k * Pi / 2), Sin(k * Pi / 2), 0, h};\n"
                           "  Point(6 + k) = {2 * Cos(k * Pi / 2), 2 * Sin(k * Pi / 2), 0, h};\n"
                           "EndFor\n"
                           "For k In {0:3}\n"
                           "  Circle(1 + k) = {2 + k, 1, 2 + (k + 1) % 4};\n"
                           "  Circle(5 + k) = {6 + k, 1, 6 + (k + 1) % 4};\n"
                           "EndFor\n"
                           "Curve Loop(1) = {1:4};\nCurve Loop(2) = {5:8};\n"
                           "Plane Surface(1) = {1};\nPlane Surface(2) = {2, 1};\n"
                           "Physical Surface(\"omega\") = {1};\n"
                           "Physical Surface(\"collar\") = {2};\n";

  /// A triangle of second order whose longest side bends outwards, and one of the collar beyond.
  const std::string second_order =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
      "$PhysicalNames\n2\n2 1 \"omega\"\n2 2 \"collar\"\n$EndPhysicalNames\n"
      "$Nodes\n9\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 .5 0 0\n5 .6 .6 0\n6 0 .5 0\n7 1 1 0\n8 1 .5 0\n"
      "9 .5 1 0\n$EndNodes\n"
      "$Elements\n2\n1 9 2 1 1 1 2 3 4 5 6\n2 9 2 2 2 2 7 3 8 9 5\n$EndElements\n";
} // namespace

TEST_F(CurvedFile, of_a_script_is_its_straight_mesh_with_sides_on_its_curves)
{
  const std::string file = write("ring.geo", ring);
  const Mesh straight = read_mesh(file, .4, .3), bent = read_mesh(file, .4, .3, true, true);
  EXPECT_EQ(bent.n_wholes(), straight.cells.size());
  const Mesh corners = straightened(bent);
  for (std::size_t c = 0; c < straight.cells.size(); ++c)
  {
    EXPECT_EQ(corners.polygon(c), straight.polygon(c));
    EXPECT_EQ(corners.cells[c].is_inside, straight.cells[c].is_inside);
  }
  EXPECT_NEAR(area(bent, true), M_PI, 1e-5);
  EXPECT_NEAR(area(bent, false), 3 * M_PI, 1e-5);
  EXPECT_GT(std::abs(area(straight, true) - M_PI), 1e-2);
  // inside of the surfaces sides are straight
  const double on_circles = 2 * M_PI * (1 + 2) / .4;
  EXPECT_LT(static_cast<double>(bent.cells.size() - straight.cells.size()),
            3 * 1.5 * 2 * on_circles);
}

TEST_F(CurvedFile, of_second_order_bends_by_its_points)
{
  const std::string file = write("second.msh", second_order);
  const Mesh mesh = read_mesh(file, .1, .1, true, true);
  EXPECT_EQ(mesh.cells.size(), 8u);
  // a parabola of height .1 √2 over a side of √2
  EXPECT_NEAR(area(mesh, true), .5 + 2. / 3 * .2, 1e-15);
  EXPECT_NEAR(area(mesh, false), .5 - 2. / 3 * .2, 1e-15);
}

TEST_F(CurvedFile, without_curves_is_refused)
{
  const auto fault = [&](const std::string &name, const std::string &text, bool is_curved)
  { return error_of([&] { read_mesh(write(name, text), .4, .3, true, is_curved); }); };
  EXPECT_TRUE(says(fault("a.msh", second_order, false), "or triangles of second to fourth order "
                                                        "with Domain/sides = curved"));
  std::string polygon = ring;
  for (std::size_t at; (at = polygon.find("Circle(1 + k) = {2 + k, 1, ")) != std::string::npos;)
    polygon.replace(at, 27, "Line(1 + k) = {2 + k, ");
  for (std::size_t at; (at = polygon.find("Circle(5 + k) = {6 + k, 1, ")) != std::string::npos;)
    polygon.replace(at, 27, "Line(5 + k) = {6 + k, ");
  EXPECT_TRUE(says(fault("b.geo", polygon, true), "has no curved side, but Domain/sides = curved"));
  EXPECT_TRUE(says(fault("c.geo", ring + "Recombine Surface {1, 2};", true),
                   "triangles of first to fourth order are allowed where sides are curved"));
}
