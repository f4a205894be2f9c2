// Galerkin entries on tetrahedra: against nested quadrature with exact volumes of ball ∩
// tetrahedron, against the lattice's exact entries, and what holds whatever the quadrature.
#include "reference/tetrahedra/assembly.h"

#include "base/error.h"
#include "geometry/ball_polyhedron.h"
#include "reference/lattice/solid_stencil.h"
#include "reference/tetrahedra/face_potential.h"
#include "reference/tetrahedra/field.h"
#include "reference/tetrahedra/repeated_rows.h"
#include "tests/reference/cube_sums.h"

#include <deal.II/base/quadrature_lib.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace
{
  using namespace plumbline;
  using namespace plumbline::reference;
  using dealii::Point;
  using geometry::layers_within;
  using geometry::six_per_cube;

  geometry::CubeLattice cubes(double side, double h)
  {
    return {{{{Point<3>(), Point<3>(side, side, side)}}, {}}, h};
  }

  physics::Kernel<3> kernel_of(const std::string &type, double horizon)
  {
    return physics::Kernel<3>::with_diffusion(physics::kernel_type(type).profile, horizon, 1);
  }

  /// Six tetrahedra per cube of side 1, two cubes a side, all vertices moved at random.
  std::shared_ptr<const TetrahedralMesh> moved_mesh(int n_layers, double move)
  {
    TetrahedralMesh mesh = six_per_cube(cubes(2, 1), n_layers);
    std::mt19937 random(7);
    for (Point<3> &x : mesh.vertices)
      for (unsigned int d = 0; d < 3; ++d)
        x[d] += move * (2 * (random() / 4294967296.) - 1);
    return std::make_shared<const TetrahedralMesh>(mesh);
  }

  std::map<unsigned int, double> first_row(const algebra::CsrMatrix &matrix)
  {
    std::map<unsigned int, double> row;
    for (std::size_t k = 0; k < matrix.start[1]; ++k)
      row[matrix.column[k]] = matrix.value[k];
    return row;
  }

  geometry::ConvexPolyhedron polyhedron(const TetrahedralMesh &mesh, std::size_t cell)
  {
    std::array<Point<3>, 4> vertices;
    for (unsigned int k = 0; k < 4; ++k)
      vertices[k] = mesh.vertices[mesh.cells[cell][k]];
    return geometry::ConvexPolyhedron::tetrahedron(vertices);
  }

  /// ∬_{|x - y| < horizon} φ_i(x) φ_j(y): over x by a rule of degree 9, over y exact.
  double overlap_of(const TetrahedralSpace &space, unsigned int i, unsigned int j, double horizon)
  {
    const dealii::QWitherdenVincentSimplex<3> rule(5);
    const TetrahedralMesh &mesh = space.mesh();
    double sum = 0;
    for (std::size_t first = 0; first < mesh.cells.size(); ++first)
      for (unsigned int a = 0; a < 4; ++a)
      {
        if (space.dof(first, a) != i || (a > 0 && space.degree() == 0))
          continue;
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const auto &s = rule.point(q);
          const std::array<double, 4> phi = {1 - s[0] - s[1] - s[2], s[0], s[1], s[2]};
          Point<3> x;
          for (unsigned int k = 0; k < 4; ++k)
            x += phi[k] * mesh.vertices[mesh.cells[first][k]];
          double inner = 0;
          for (std::size_t second = 0; second < mesh.cells.size(); ++second)
            for (unsigned int b = 0; b < 4; ++b)
            {
              if (space.dof(second, b) != j || (b > 0 && space.degree() == 0))
                continue;
              const auto common = geometry::intersect({x, horizon}, polyhedron(mesh, second), 1);
              const Point<3> &next = mesh.vertices[mesh.cells[second][(b + 1) % 4]];
              inner +=
                  common.volume *
                  (space.degree() > 0 ? gradients(mesh, second)[b] * (common.centroid - next) : 1);
            }
          sum +=
              rule.weight(q) * determinant(mesh, first) * (space.degree() > 0 ? phi[a] : 1) * inner;
        }
      }
    return sum;
  }
} // namespace

TEST(Tetrahedra, fill_the_cubes_and_conform)
{
  const auto mesh = std::make_shared<const TetrahedralMesh>(six_per_cube(cubes(1, .5), 1));
  double inside = 0, all = 0;
  for (std::size_t cell = 0; cell < mesh->cells.size(); ++cell)
  {
    EXPECT_NEAR(determinant(*mesh, cell), 1. / 8, 1e-15);
    all += determinant(*mesh, cell) / 6;
    inside += mesh->is_inside[cell] != 0 ? determinant(*mesh, cell) / 6 : 0;
  }
  EXPECT_NEAR(all, 8, 1e-13);
  EXPECT_NEAR(inside, 1, 1e-14);
  // each face has two cells, but for those of the outside: two for each side of an outer cube
  const TetrahedralSpace constants(mesh, false);
  std::size_t n_outer = 0;
  for (const SpaceFace &face : make_faces(constants))
  {
    ASSERT_LE(face.jumps.size(), 2u);
    if (face.jumps.size() == 1)
      ++n_outer;
    else
    {
      EXPECT_EQ(face.jumps[0].value, -face.jumps[1].value);
    }
  }
  EXPECT_EQ(n_outer, 6u * 16 * 2);
  EXPECT_EQ(constants.n_free(), 48u);
  EXPECT_EQ(TetrahedralSpace(mesh, true).n_free(), 1u);
}

TEST(TetrahedralEntries, annihilate_linear_fields_whatever_the_quadrature)
{
  for (const std::string type : {"constant", "1/r"})
  {
    const double horizon = 1.3;
    const TetrahedralSpace space(moved_mesh(3, .2), true);
    const auto row =
        first_row(assemble_by_faces(space, kernel_of(type, horizon), 1, FaceRule::quadrature(0)));
    double sum = 0;
    dealii::Tensor<1, 3> first;
    for (const auto &[column, value] : row)
    {
      sum += value;
      first += value * (space.support(column) - space.support(0));
    }
    EXPECT_NEAR(sum / row.at(0), 0, 1e-13) << type;
    EXPECT_NEAR(first.norm() / row.at(0), 0, 1e-13) << type;
  }
}

TEST(TetrahedralEntries, have_the_second_moments_of_the_local_limit_on_lattices)
{
  const double h = .25, horizon = .6;
  const auto lattice = cubes(2 * h, h);
  const TetrahedralSpace space(std::make_shared<const TetrahedralMesh>(six_per_cube(lattice, 3)),
                               true);
  const auto row = first_row(
      assemble_by_faces(space, kernel_of("linear-decay", horizon), 1, FaceRule::quadrature(0)));
  dealii::SymmetricTensor<2, 3> second;
  for (const auto &[column, value] : row)
  {
    const dealii::Tensor<1, 3> xi = space.support(column) - space.support(0);
    second -= .5 / std::pow(h, 3) * value * symmetrize(outer_product(xi, xi));
  }
  EXPECT_LT((second - dealii::unit_symmetric_tensor<3>()).norm(), 1e-11);
}

TEST(TetrahedralEntries, are_those_of_nested_quadrature)
{
  const double horizon = 1.2;
  const auto kernel = kernel_of("constant", horizon);
  for (const bool is_continuous : {true, false})
  {
    const TetrahedralSpace space(moved_mesh(3, .2), is_continuous);
    const auto coarse = first_row(assemble_by_faces(space, kernel, 1, FaceRule::quadrature(0))),
               row = first_row(assemble_by_faces(space, kernel, 1, FaceRule::quadrature(2)));
    unsigned int n_compared = 0;
    double worst = 0, worst_coarse = 0;
    for (const auto &[column, value] : row)
      if (column % 17 == 1 && std::abs(value) > 1e-5 * row.at(0))
      {
        const double expected = -kernel.constant() * overlap_of(space, 0, column, horizon);
        worst = std::max(worst, std::abs(value - expected));
        worst_coarse = std::max(worst_coarse, std::abs(coarse.at(column) - expected));
        ++n_compared;
      }
    EXPECT_GT(n_compared, 6u);
    EXPECT_LT(worst / row.at(0), is_continuous ? 2e-5 : 2e-4) << is_continuous;
    EXPECT_LT(worst_coarse / row.at(0), 1e-3) << is_continuous;
  }
}

TEST(TetrahedralEntries, of_discontinuous_linear_functions_are_those_of_nested_quadrature)
{
  const double horizon = 1.2;
  const auto kernel = kernel_of("constant", horizon);
  const TetrahedralSpace space(moved_mesh(3, .2), TetrahedralShapes::discontinuous_linear());
  FaceRule rule = FaceRule::exact();
  rule.of_jumps = 1e-5;
  const auto row = first_row(assemble_by_faces(space, kernel, 4, rule));
  unsigned int n_compared = 0;
  double worst = 0;
  for (const auto &[column, value] : row)
    if (column > 3 && column % 23 == 1 && std::abs(value) > 1e-4 * row.at(0))
    {
      const double expected = -kernel.constant() * overlap_of(space, 0, column, horizon);
      worst = std::max(worst, std::abs(value - expected));
      ++n_compared;
    }
  EXPECT_GT(n_compared, 20u);
  EXPECT_LT(worst / row.at(0), 3e-4);
}

TEST(TetrahedralEntries, of_the_cells_of_cubes_add_up_to_exact_ones_of_cubes)
{
  const double h = 1, horizon = 1.7;
  const auto lattice = cubes(1, h);
  const TetrahedralSpace space(std::make_shared<const TetrahedralMesh>(six_per_cube(lattice, 2)),
                               false);
  for (const std::string type : {"constant", "linear-decay", "1/r"})
  {
    const auto kernel = kernel_of(type, horizon);
    const auto stencil = galerkin_stencil(kernel, h, AxisShapes(false, 0));
    double before = 1;
    for (const unsigned int refinement : {0u, 2u})
    {
      const auto matrix = assemble_by_faces(space, kernel, 6, FaceRule::quadrature(refinement));
      const double worst = error_of_cube_sums(matrix, space, stencil);
      EXPECT_LT(worst, refinement == 0 ? 2e-3 : 2e-4) << type;
      EXPECT_LT(worst, before) << type;
      before = worst;
    }
  }
}

TEST(TetrahedralEntries, of_kernels_with_breaks_and_of_polynomials_are_sums)
{
  const double horizon = 1.5;
  const TetrahedralSpace space(moved_mesh(3, .1), true);
  const auto row = [&](const physics::RadialProfile &profile)
  {
    return first_row(assemble_by_faces(space, {physics::Structure::scalar, profile, horizon, 1}, 1,
                                       FaceRule::quadrature(0)));
  };
  // 1 - t as a table, and as powers; constant up to 1/2
  const auto decay = row({{1, 0}, {-1, 1}}),
             table = row(physics::RadialProfile::table({{0, 1}, {.3, .7}, {1, 0}})),
             broken = row(physics::RadialProfile::table({{0, 2}, {.5, 1}, {1, 0}}));
  double worst = 0;
  for (const auto &[column, value] : decay)
  {
    worst = std::max(worst, std::abs(table.at(column) - value));
    worst = std::max(worst, std::abs(broken.at(column) - 2 * value));
  }
  EXPECT_LT(worst / decay.at(0), 1e-12);
}

TEST(TetrahedralEntries, of_functions_are_those_of_powers_and_of_quadrature)
{
  const double horizon = 1.5;
  for (const bool is_continuous : {true, false})
  {
    const TetrahedralSpace space(moved_mesh(3, .1), is_continuous);
    const auto row = [&](const physics::RadialProfile &profile, const FaceRule &rule)
    {
      return first_row(
          assemble_by_faces(space, {physics::Structure::scalar, profile, horizon, 1}, 1, rule));
    };
    const auto worst = [](const auto &a, const auto &b)
    {
      double change = 0;
      for (const auto &[column, value] : a)
      {
        const auto other = b.find(column); // all may cancel
        change = std::max(change, std::abs((other == b.end() ? 0 : other->second) - value));
      }
      return change / a.at(0);
    };
    const auto decay = physics::RadialProfile::smooth([](double t) { return 1 - t; }, false);
    EXPECT_LT(worst(row({{1, 0}, {-1, 1}}, FaceRule::exact()), row(decay, FaceRule::exact())),
              1e-12);
    const auto gaussian = physics::kernel_type("gaussian").make({{}, 0, .4});
    const auto exact = row(gaussian, FaceRule::exact());
    EXPECT_LT(worst(exact, row(gaussian, FaceRule::quadrature(1))), 2e-2);
    double sum = 0;
    dealii::Tensor<1, 3> first;
    for (const auto &[column, value] : exact)
    {
      sum += value;
      first += value * (space.support(column) - space.support(0));
    }
    EXPECT_NEAR(sum / exact.at(0), 0, 1e-12);
    if (is_continuous)
    {
      EXPECT_NEAR(first.norm() / exact.at(0), 0, 1e-12);
    }
  }
}

TEST(TetrahedralEntries, on_lattices_are_repeated)
{
  const auto lattice = cubes(1.5, .5);
  const double horizon = .6;
  const auto kernel = kernel_of("constant", horizon);
  for (const bool is_continuous : {true, false})
  {
    const TetrahedralSpace space(std::make_shared<const TetrahedralMesh>(
                                     six_per_cube(lattice, layers_within(horizon, lattice.h()))),
                                 is_continuous);
    const RepeatedRows rows(kernel, lattice.h(), is_continuous, FaceRule::quadrature(0));
    const auto repeated = rows.on(space, lattice);
    ASSERT_EQ(repeated.n_rows(), space.n_free());
    const std::size_t n_rows = is_continuous ? space.n_free() : 6;
    const auto all = assemble_by_faces(space, kernel, n_rows, FaceRule::quadrature(0));
    double worst = 0, largest = 0;
    for (std::size_t row = 0; row < n_rows; ++row)
    {
      std::map<unsigned int, double> entries;
      for (std::size_t k = all.start[row]; k < all.start[row + 1]; ++k)
        entries[all.column[k]] = all.value[k];
      for (std::size_t k = repeated.start[row]; k < repeated.start[row + 1]; ++k)
        entries[repeated.column[k]] -= repeated.value[k];
      for (const auto &[column, difference] : entries)
        worst = std::max(worst, std::abs(difference));
      largest = std::max(largest, std::abs(all.value[all.start[row]]));
    }
    EXPECT_LT(worst, 1e-12 * largest);
    EXPECT_EQ(rows.difference(rows), 0);
    EXPECT_GT(
        rows.difference(RepeatedRows(kernel, lattice.h(), is_continuous, FaceRule::quadrature(1))),
        1e-7);
  }
}

TEST(TetrahedralEntries, are_refused_for_kernels_without_potentials)
{
  const auto refused = [](const std::string &type, const physics::RadialProfile &profile) {
    return FacePotential::refuse({physics::kernel_type(type).structure, profile, 1, 1});
  };
  EXPECT_EQ(refused("constant", {{1, 0}}), "");
  EXPECT_EQ(refused("1/r", {{1, -1}}), "");
  EXPECT_NE(refused("1/r", {{1, -2}}).find("1/r"), std::string::npos);
  EXPECT_EQ(refused("constant", physics::RadialProfile::smooth(
                                    [](double t) { return std::exp(-t * t); }, true)),
            "");
}

TEST(TetrahedralFields, are_linear_where_they_should_be)
{
  const auto lattice = cubes(1, .25);
  const auto space = std::make_shared<const TetrahedralSpace>(
      std::make_shared<const TetrahedralMesh>(six_per_cube(lattice, 1)), true);
  const auto linear = [](const Point<3> &x) { return 2 + x[0] - 3 * x[1] + .5 * x[2]; };
  std::vector<double> values;
  for (std::size_t dof = 0; dof < space->n_dofs(); ++dof)
    values.push_back(linear(space->support(dof)));
  const TetrahedralField field(space, values);
  for (const Point<3> &x : {Point<3>(.1, .83, .4), Point<3>(0, 0, 0), Point<3>(1, .5, .25)})
  {
    EXPECT_NEAR(field.value(x), linear(x), 1e-13);
    EXPECT_NEAR((field.gradient(x) - Point<3>(1, -3, .5)).norm(), 0, 1e-12);
  }
  EXPECT_THROW(field.value({1.1, .5, .5}), NumericalError);
  const auto averages = field.averages(lattice);
  ASSERT_EQ(averages.size(), 64u);
  EXPECT_NEAR(averages[1], linear({.375, .125, .125}), 1e-13);

  // a load of degree 4 is tested exactly
  const problem::Field<3> load{[](const Point<3> &x, unsigned int)
                               { return std::pow(x[0], 3) * x[1]; }};
  const auto tested = tested_load(load, *space);
  double sum = 0, moment = 0;
  for (std::size_t dof = 0; dof < space->n_free(); ++dof)
    if (space->support(dof).distance(Point<3>(.5, .5, .5)) < 1e-9)
      sum = tested[dof];
  const dealii::QWitherdenVincentSimplex<3> rule(5);
  for (std::size_t cell = 0; cell < space->mesh().cells.size(); ++cell)
    for (unsigned int corner = 0; corner < 4; ++corner)
      if (space->support(space->dof(cell, corner)).distance(Point<3>(.5, .5, .5)) < 1e-9)
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const auto &s = rule.point(q);
          const std::array<double, 4> phi = {1 - s[0] - s[1] - s[2], s[0], s[1], s[2]};
          Point<3> x;
          for (unsigned int k = 0; k < 4; ++k)
            x += phi[k] * space->mesh().vertices[space->mesh().cells[cell][k]];
          moment +=
              rule.weight(q) * determinant(space->mesh(), cell) * phi[corner] * load.value(x, 0);
        }
  EXPECT_NEAR(sum, moment, 1e-14);
}

TEST(Tetrahedra, are_moved_inside_the_domain_and_its_collar_and_keep_their_volume)
{
  const auto lattice = cubes(1, .25);
  const auto regular = six_per_cube(lattice, 2),
             moved = geometry::with_moved_vertices(regular, .45 * .25, 3),
             narrow = geometry::with_moved_vertices(six_per_cube(lattice, 1), .45 * .25, 3);
  const auto is_inner = geometry::inner_vertices(regular);
  unsigned int n_moved = 0;
  for (std::size_t vertex = 0; vertex < regular.vertices.size(); ++vertex)
  {
    const Point<3> &place = regular.vertices[vertex], &at = moved.vertices[vertex];
    bool is_on_surface = false, is_outside = false;
    for (unsigned int d = 0; d < 3; ++d)
    {
      is_outside = is_outside || place[d] < 0 || place[d] > 1;
      is_on_surface = is_on_surface || place[d] == -.5 || place[d] == 1.5;
    }
    is_on_surface = is_on_surface || (!is_outside && is_inner[vertex] == 0);
    EXPECT_LE(at.distance(place), is_on_surface ? 0 : .45 * .25 * std::sqrt(3.));
    n_moved += at.distance(place) > 0 ? 1 : 0;
    if (is_inner[vertex] != 0) // whatever is around
    {
      EXPECT_EQ(std::count(narrow.vertices.begin(), narrow.vertices.end(), at), 1);
    }
  }
  EXPECT_EQ(n_moved, 27u + 7 * 7 * 7 - 5 * 5 * 5);
  double volume = 0;
  for (std::size_t cell = 0; cell < moved.cells.size(); ++cell)
  {
    EXPECT_GE(determinant(moved, cell), .0999 * determinant(regular, cell));
    volume += moved.is_inside[cell] != 0 ? determinant(moved, cell) / 6 : 0;
  }
  EXPECT_NEAR(volume, 1, 1e-13);
  double nodes = 0;
  for (const double share :
       volumes(TetrahedralSpace(std::make_shared<const geometry::TetrahedralMesh>(moved), false)))
    nodes += share;
  EXPECT_NEAR(nodes, 1, 1e-13);
}
