// Entries of discontinuous linear functions on tetrahedra: sums of them against exact entries of
// continuous functions, of constants, and of linear functions on cubes; integrals over pairs of
// faces against products of Gauss rules.
#include "reference/tetrahedra/jump_assembly.h"

#include "physics/gauss.h"
#include "reference/lattice/solid_stencil.h"
#include "reference/tetrahedra/exact_pairs.h"
#include "reference/tetrahedra/jump_pairs.h"

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
  using Triangle = PairFace::Vertices;
  using Rows = std::vector<std::map<unsigned int, double>>;

  physics::Kernel<3> kernel_of(const std::string &type, double horizon)
  {
    return physics::Kernel<3>::with_diffusion(physics::kernel_type(type).profile, horizon, 1);
  }

  std::shared_ptr<const TetrahedralMesh> mesh_of_cubes(double side, int n_layers, double move)
  {
    TetrahedralMesh mesh =
        geometry::six_per_cube({{{{Point<3>(), Point<3>(side, side, side)}}, {}}, 1}, n_layers);
    std::mt19937 random(7);
    for (Point<3> &x : mesh.vertices)
      for (unsigned int d = 0; d < 3; ++d)
        x[d] += move * (2 * (random() / 4294967296.) - 1);
    return std::make_shared<const TetrahedralMesh>(mesh);
  }

  Rows rows_of(const algebra::CsrMatrix &matrix)
  {
    Rows rows(matrix.n_rows());
    for (std::size_t row = 0; row < rows.size(); ++row)
      for (std::size_t k = matrix.start[row]; k < matrix.start[row + 1]; ++k)
        rows[row][matrix.column[k]] = matrix.value[k];
    return rows;
  }

  FaceRule rule_with(double of_jumps, double spacing = 0)
  {
    FaceRule rule = FaceRule::exact();
    rule.tolerance = 1e-12;
    rule.of_jumps = of_jumps;
    rule.spacing = spacing;
    return rule;
  }

  /// The largest difference to the first row of another matrix, relative to its diagonal.
  double difference(std::map<unsigned int, double> sums,
                    const std::map<unsigned int, double> &expected)
  {
    for (const auto &[column, value] : expected)
      sums[column] -= value;
    double worst = 0;
    for (const auto &[column, change] : sums)
      worst = std::max(worst, std::abs(change));
    return worst / expected.at(0);
  }
} // namespace

TEST(JumpEntries, of_continuous_sums_are_exact_whatever_the_quadrature)
{
  const double horizon = 1.3;
  const auto mesh = mesh_of_cubes(2, 3, .2);
  const TetrahedralSpace continuous(mesh, true),
      space(mesh, TetrahedralShapes::discontinuous_linear());
  ASSERT_EQ(space.n_free(), 4u * 48);
  std::map<unsigned int, unsigned int> vertex; // of unknowns
  for (std::size_t cell = 0; cell < mesh->cells.size(); ++cell)
    for (unsigned int corner = 0; corner < 4; ++corner)
      vertex[space.dof(cell, corner)] = continuous.dof(cell, corner);
  constexpr double coarse = 1e-2;
  const auto kernel = kernel_of("1/r", horizon);
  const Rows rows = rows_of(assemble_by_faces(space, kernel, space.n_free(), rule_with(coarse)));
  std::map<unsigned int, double> sums;
  for (unsigned int row = 0; row < rows.size(); ++row)
  {
    double sum = 0;
    dealii::Tensor<1, 3> first;
    for (const auto &[column, value] : rows[row])
    {
      sum += value;
      first += value * (space.support(column) - space.support(row));
      if (vertex.at(row) == 0)
        sums[vertex.at(column)] += value;
      if (column < rows.size())
      {
        EXPECT_EQ(value, rows[column].at(row));
      }
    }
    EXPECT_NEAR(sum / rows[row].at(row), 0, 1e-13);
    EXPECT_NEAR(first.norm() / rows[row].at(row), 0, 1e-13);
  }
  const Rows exact = rows_of(assemble_by_faces(continuous, kernel, 1, FaceRule::exact()));
  EXPECT_LT(difference(sums, exact[0]), 1e-11);
}

TEST(JumpEntries, of_cells_add_up_to_those_of_constants)
{
  const double horizon = 1.3;
  const auto mesh = mesh_of_cubes(2, 3, .2);
  const TetrahedralSpace constants(mesh, false),
      space(mesh, TetrahedralShapes::discontinuous_linear());
  for (const std::string type : {"constant", "linear-decay"})
  {
    const auto kernel = kernel_of(type, horizon);
    const Rows exact = rows_of(assemble_by_faces(constants, kernel, 1, FaceRule::exact()));
    double before = 1;
    for (const double tolerance : {1e-3, 1e-5})
    {
      std::map<unsigned int, double> sums;
      for (const auto &row : rows_of(assemble_by_faces(space, kernel, 4, rule_with(tolerance))))
        for (const auto &[column, value] : row)
          sums[column / 4] += value;
      const double error = difference(sums, exact[0]);
      EXPECT_LT(error, std::min(2 * tolerance, before)) << type << " " << tolerance;
      before = error;
    }
  }
}

// With jumps across the sides of cubes alone.
TEST(JumpEntries, of_linear_functions_on_cubes_are_exact_ones_of_cubes)
{
  const double horizon = 1.7;
  const auto mesh = mesh_of_cubes(1, 2, 0);
  const TetrahedralSpace space(mesh, TetrahedralShapes::discontinuous_linear());
  using Cube = std::array<int, 3>;
  std::map<unsigned int, Cube> cubes; // of unknowns
  for (std::size_t cell = 0; cell < mesh->cells.size(); ++cell)
    for (unsigned int corner = 0; corner < 4; ++corner)
    {
      Point<3> centre;
      for (const unsigned int vertex : mesh->cells[cell])
        centre += mesh->vertices[vertex] / 4;
      for (unsigned int d = 0; d < 3; ++d)
        cubes[space.dof(cell, corner)][d] = static_cast<int>(std::floor(centre[d]));
    }
  // functions 1, x, y and z about the centre of a cube
  const auto value = [](unsigned int k, const Cube &cube, const Point<3> &x)
  { return k == 0 ? 1 : x[k - 1] - cube[k - 1] - .5; };
  for (const std::string type : {"constant", "1/r"})
  {
    const auto kernel = kernel_of(type, horizon);
    const Rows rows = rows_of(assemble_by_faces(space, kernel, 24, rule_with(1e-6, 1)));
    std::map<Cube, std::array<std::array<double, 4>, 4>> sums;
    for (unsigned int row = 0; row < rows.size(); ++row)
      for (const auto &[column, entry] : rows[row])
        for (unsigned int i = 0; i < 4; ++i)
          for (unsigned int j = 0; j < 4; ++j)
            sums[cubes.at(column)][i][j] += entry * value(i, cubes.at(row), space.support(row)) *
                                            value(j, cubes.at(column), space.support(column));
    const auto stencil = galerkin_stencil(kernel, 1, AxisShapes(false, 1));
    const auto corner = [](unsigned int family)
    { return Point<3>(family % 2, family / 2 % 2, family / 4); };
    double worst = 0;
    for (const auto &[cube, matrix] : sums)
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int j = 0; j < 4; ++j)
        {
          double expected = 0;
          for (unsigned int f = 0; f < 8; ++f)
            for (unsigned int g = 0; g < 8; ++g)
              expected += stencil(f, g, cube[0], cube[1], cube[2]) * value(i, {}, corner(f)) *
                          value(j, {}, corner(g));
          worst = std::max(worst, std::abs(matrix[i][j] - expected));
        }
    EXPECT_GT(sums.size(), 100u);
    EXPECT_LT(worst, 5e-6 * std::abs(sums.at({0, 0, 0})[1][1])) << type;
  }
}

TEST(JumpEntries, come_with_the_number_of_pairs_that_do_not_reach_the_tolerance)
{
  const TetrahedralSpace space(mesh_of_cubes(1, 1, 0), TetrahedralShapes::discontinuous_linear());
  const auto use_with = [&space](double tolerance)
  {
    FaceRuleUse use;
    assemble_by_faces(space, kernel_of("constant", .2), 4, rule_with(tolerance, 1), &use);
    return use;
  };
  const FaceRuleUse possible = use_with(1e-4), impossible = use_with(1e-30);
  EXPECT_EQ(possible.n_open, 0u);
  EXPECT_EQ(possible.open, 0);
  EXPECT_GT(impossible.n_open, 10u);
  EXPECT_GT(impossible.open, 1e-30);
  EXPECT_LT(impossible.open, 1e-2);
  RecordProperty("open", std::to_string(impossible.n_open) + " " +
                             std::to_string(1e9 * impossible.open) + "e-9");
}

TEST(JumpPairs, are_those_of_products_of_gauss_rules)
{
  const auto kernel = kernel_of("linear-decay", 1);
  const Triangle x = {Point<3>(0, 0, 0), Point<3>(.2, .02, .05), Point<3>(.03, .2, 0)},
                 y = {Point<3>(.3, .3, .2), Point<3>(.4, .35, .3), Point<3>(.25, .5, .2)};
  const PairFace f(x, {0, 1, 2}), g(y, {3, 4, 5});
  const JumpIntegrals integrals = JumpPairs(kernel, 1e-12)(f, g);
  const auto normal = [](const Triangle &t)
  {
    const auto area = cross_product_3d(t[1] - t[0], t[2] - t[0]);
    return area / area.norm();
  };
  // Λ, and Ψ'/r by differences
  const FacePotential harmonic(kernel, FacePotential::Kind::harmonic),
      biharmonic(kernel, FacePotential::Kind::biharmonic);
  const auto at = [](const FacePotential &potential, double r)
  {
    const double square = r * r, weight = 1;
    return potential.sum(&square, &weight, 1);
  };
  const auto slope = [&](double r)
  {
    constexpr double step = 1e-3;
    return (8 * (at(biharmonic, r + step) - at(biharmonic, r - step)) -
            (at(biharmonic, r + 2 * step) - at(biharmonic, r - 2 * step))) /
           (12 * step * r);
  };
  const auto &gauss = physics::gauss(8);
  JumpIntegrals expected;
  const auto for_points = [&](const Triangle &t, const auto &visit)
  {
    for (unsigned int j = 0; j < 8; ++j)
      for (unsigned int k = 0; k < 8; ++k)
      {
        const double a = gauss.point(j)[0], b = a * gauss.point(k)[0];
        const std::array<double, 3> s = {1 - a, a - b, b};
        visit(Point<3>(s[0] * t[0] + s[1] * t[1] + s[2] * t[2]), s,
              gauss.weight(j) * gauss.weight(k) * a *
                  cross_product_3d(t[1] - t[0], t[2] - t[0]).norm());
      }
  };
  for_points(x,
             [&](const Point<3> &p, const std::array<double, 3> &s, double w)
             {
               for_points(y,
                          [&](const Point<3> &q, const std::array<double, 3> &t, double v)
                          {
                            const double r = p.distance(q), value = w * v * at(harmonic, r),
                                         change = w * v * slope(r);
                            for (unsigned int a = 0; a < 3; ++a)
                            {
                              expected.first[a] += s[a] * change * (normal(y) * (p - y[0]));
                              expected.second[a] += t[a] * change * (normal(x) * (q - x[0]));
                              for (unsigned int b = 0; b < 3; ++b)
                                expected.values[a][b] += s[a] * t[b] * value;
                            }
                          });
             });
  for (unsigned int a = 0; a < 3; ++a)
  {
    EXPECT_NEAR(integrals.first[a], expected.first[a], 1e-7 * std::abs(expected.first[a]));
    EXPECT_NEAR(integrals.second[a], expected.second[a], 1e-7 * std::abs(expected.second[a]));
    for (unsigned int b = 0; b < 3; ++b)
      EXPECT_NEAR(integrals.values[a][b], expected.values[a][b], 1e-8 * expected.values[a][b]);
  }
  const JumpIntegrals other = JumpPairs(kernel, 1e-12)(g, f);
  EXPECT_EQ(other.first, integrals.second);
  EXPECT_EQ(other.values[0][2], integrals.values[2][0]);
}
