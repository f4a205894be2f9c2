// Entries of bond tensors on tetrahedra: against exact ones of cubes, against scalar kernels by
// their trace, against product rules, under rotations, and what all entries obey.
#include "reference/lattice/solid_stencil.h"
#include "reference/tetrahedra/assembly.h"
#include "reference/tetrahedra/face_potential.h"
#include "reference/tetrahedra/repeated_rows.h"
#include "reference/tetrahedra/solid_kernel.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/physics/transformations.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>

namespace
{
  using namespace plumbline;
  using namespace plumbline::reference;
  using dealii::Point;
  using Block = dealii::Tensor<2, 3>;
  using Blocks = std::map<unsigned int, Block>; ///< of a row of three, by node
  using physics::RadialProfile;
  using physics::Structure;

  /// Sums of powers: singular, smooth, and both.
  const std::vector<RadialProfile> powers = {{{1, -1}}, {{1, 1}}, {{2, -1}, {-3, 1}, {1, 2}}};
  /// Their parts have logarithms.
  const std::vector<RadialProfile> with_constants = {{{1, 0}}, {{1, 0}, {-1, 1}}};

  std::vector<RadialProfile> all_profiles()
  {
    std::vector<RadialProfile> all = powers;
    all.insert(all.end(), with_constants.begin(), with_constants.end());
    return all;
  }

  TetrahedralMesh mesh_of_cubes(double side, int n_layers)
  {
    return geometry::six_per_cube({{{{Point<3>(), Point<3>(side, side, side)}}, {}}, 1}, n_layers);
  }

  TetrahedralMesh moved_mesh(double side, int n_layers, double move)
  {
    TetrahedralMesh mesh = mesh_of_cubes(side, n_layers);
    std::mt19937 random(7);
    for (Point<3> &x : mesh.vertices)
      for (unsigned int d = 0; d < 3; ++d)
        x[d] += move * (2 * (random() / 4294967296.) - 1);
    return mesh;
  }

  TetrahedralSpace space_of(const TetrahedralMesh &mesh, bool is_continuous)
  {
    return {std::make_shared<const TetrahedralMesh>(mesh), is_continuous};
  }

  struct Solid
  {
    physics::Kernel<3> bonds;
    std::optional<physics::Dilatation<3>> dilatation = {};

    double reach() const { return bonds.horizon() * (dilatation ? 2 : 1); }
  };

  Solid bond_based(const RadialProfile &profile, double horizon)
  {
    return {{Structure::tensor, profile, horizon, 1}};
  }

  /// @param lambda  mu is 1
  Solid state_based(const RadialProfile &profile, double horizon, double lambda)
  {
    const auto influence = physics::influence_function<3>(profile, horizon);
    return {physics::deviatoric_kernel(influence, 1),
            physics::Dilatation<3>{influence,
                                   [lambda](const Point<3> &) {
                                     return physics::Lame{lambda, 1};
                                   },
                                   false, true}};
  }

  /// All solids that reach this far.
  std::vector<Solid> solids(double reach)
  {
    std::vector<Solid> all;
    for (const RadialProfile &profile : powers)
      all.push_back(bond_based(profile, reach));
    all.push_back(state_based(powers[0], reach / 2, 3));
    all.push_back(state_based(powers[2], reach / 2, -.5));
    return all;
  }

  /// Rows of a node.
  Blocks blocks(const algebra::CsrMatrix &matrix, std::size_t node)
  {
    Blocks result;
    for (unsigned int a = 0; a < 3; ++a)
      for (std::size_t k = matrix.start[3 * node + a]; k < matrix.start[3 * node + a + 1]; ++k)
        result[matrix.column[k] / 3][a][matrix.column[k] % 3] = matrix.value[k];
    return result;
  }

  /// @param spacing  of a lattice with the vertices, or 0
  algebra::CsrMatrix exact_rows(const TetrahedralSpace &space, const Solid &solid,
                                std::size_t n_rows, double spacing = 0)
  {
    FaceRule rule = FaceRule::exact();
    rule.spacing = spacing;
    return assemble_by_faces(space, solid.bonds, n_rows, rule, nullptr, solid.dilatation);
  }
} // namespace

TEST(TensorEntries, of_the_cells_of_cubes_add_up_to_exact_ones_of_cubes)
{
  const double reach = 1.7;
  const TetrahedralSpace space = space_of(mesh_of_cubes(1, 2), false);
  for (const Solid &solid : solids(reach))
  {
    const auto stencil = galerkin_stencil(solid.bonds, 1, AxisShapes(false, 0), solid.dilatation);
    const auto matrix = exact_rows(space, solid, 6, 1);
    std::map<std::array<int, 3>, Block> sums;
    for (std::size_t cell = 0; cell < 6; ++cell)
      for (const auto &[other, block] : blocks(matrix, cell))
      {
        std::array<int, 3> cube{};
        for (unsigned int d = 0; d < 3; ++d)
          cube[d] = static_cast<int>(std::floor(space.support(other)[d]));
        sums[cube] += block;
      }
    EXPECT_GT(sums.size(), 60u);
    double worst = 0;
    for (const auto &[cube, sum] : sums)
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int b = 0; b < 3; ++b)
          worst = std::max(worst, std::abs(sum[a][b] - stencil(a, b, cube[0], cube[1], cube[2])));
    EXPECT_LT(worst / stencil(0, 0, 0, 0, 0), 1e-12);
  }
}

TEST(TensorEntries, of_layers_of_cubes_are_those_of_trilinear_functions)
{
  // both spaces have the piecewise linear functions of one coordinate
  const double reach = 1.7;
  const TetrahedralSpace space = space_of(mesh_of_cubes(2, 3), true);
  for (const Solid &solid : solids(reach))
  {
    const auto stencil = galerkin_stencil(solid.bonds, 1, AxisShapes(true, 1), solid.dilatation);
    const auto rows = blocks(exact_rows(space, solid, 1, 1), 0);
    for (unsigned int axis = 0; axis < 3; ++axis)
      for (int layer = 0; layer <= 3; ++layer)
      {
        Block expected, sum;
        for (int j = -3; j <= 3; ++j)
          for (int k = -3; k <= 3; ++k)
          {
            std::array<int, 3> at{};
            at[axis] = layer;
            at[(axis + 1) % 3] = j;
            at[(axis + 2) % 3] = k;
            for (unsigned int a = 0; a < 3; ++a)
              for (unsigned int b = 0; b < 3; ++b)
                expected[a][b] += stencil(a, b, at[0], at[1], at[2]);
          }
        for (const auto &[node, block] : rows)
          if (std::lround(space.support(node)[axis] - space.support(0)[axis]) == layer)
            sum += block;
        EXPECT_LT((sum - expected).norm() / stencil(0, 0, 0, 0, 0), 1e-12) << axis << layer;
      }
  }
}

TEST(TensorEntries, have_the_trace_of_scalar_kernels_and_annihilate_linear_fields)
{
  const double horizon = 1.3;
  for (const bool is_continuous : {true, false})
  {
    const TetrahedralSpace space = space_of(moved_mesh(2, 3, .2), is_continuous);
    for (const RadialProfile &profile : all_profiles())
    {
      const auto rows = blocks(exact_rows(space, bond_based(profile, horizon), 1), 0);
      const auto scalar = exact_rows(space, {{Structure::scalar, profile, horizon, 1}}, 1);
      std::map<unsigned int, double> traces;
      Block sum;
      dealii::Tensor<3, 3> first;
      for (const auto &[node, block] : rows)
      {
        traces[node] = trace(block);
        sum += block;
        first += outer_product(block, space.support(node) - space.support(0));
      }
      const double diagonal = traces.at(0);
      for (std::size_t k = 0; k < scalar.start[1]; ++k)
        traces[scalar.column[k]] -= scalar.value[k];
      double worst = 0;
      for (const auto &[node, difference] : traces)
        worst = std::max(worst, std::abs(difference));
      EXPECT_LT(worst / diagonal, 1e-12);
      EXPECT_LT(sum.norm() / diagonal, 1e-12);
      if (is_continuous)
      {
        EXPECT_LT(first.norm() / diagonal, 1e-12);
      }
    }
  }
}

TEST(TensorEntries, are_those_of_product_rules_where_cells_are_apart_and_within_the_horizon)
{
  const double horizon = 5;
  const TetrahedralMesh mesh = moved_mesh(1, 5, .2);
  const TetrahedralSpace space = space_of(mesh, false);
  const dealii::QWitherdenVincentSimplex<3> rule(5);
  const auto at = [&mesh](std::size_t cell, const Point<3> &s)
  {
    const auto &v = mesh.cells[cell];
    return Point<3>((1 - s[0] - s[1] - s[2]) * mesh.vertices[v[0]] + s[0] * mesh.vertices[v[1]] +
                    s[1] * mesh.vertices[v[2]] + s[2] * mesh.vertices[v[3]]);
  };
  std::vector<std::size_t> cell_of(space.n_dofs());
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    cell_of[space.dof(cell, 0)] = cell;
  const Solid solid = bond_based(powers[2], horizon);
  const physics::Kernel<3> &kernel = solid.bonds;
  const auto rows = blocks(exact_rows(space, solid, 1), 0);
  const double diagonal = rows.at(0)[0][0];
  unsigned int n_compared = 0;
  for (const auto &[other, block] : rows)
  {
    const double distance = space.support(other).distance(space.support(0));
    if (distance < 2.7 || distance > 2.9)
      continue;
    Block expected;
    for (unsigned int p = 0; p < rule.size(); ++p)
      for (unsigned int q = 0; q < rule.size(); ++q)
      {
        const Point<3> xi(at(cell_of[other], rule.point(q)) - at(cell_of[0], rule.point(p)));
        const double weight = rule.weight(p) * rule.weight(q) * kernel.radial(xi.norm());
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3; ++b)
            expected[a][b] -= weight * kernel.direction_factor(a, b, xi);
      }
    expected *= determinant(mesh, cell_of[0]) * determinant(mesh, cell_of[other]);
    EXPECT_LT((block - expected).norm(), 1e-9 * diagonal);
    EXPECT_GT(expected.norm(), 1e-4 * diagonal);
    ++n_compared;
  }
  EXPECT_GT(n_compared, 50u);
}

TEST(TensorEntries, turn_with_the_mesh_and_are_symmetric_to_the_last_bit)
{
  const double reach = 1.3, angle = .7;
  const TetrahedralMesh mesh = moved_mesh(3, 3, .2);
  const Block turn = dealii::Physics::Transformations::Rotations::rotation_matrix_3d(
      dealii::Tensor<1, 3>({1 / 3., 2 / 3., -2 / 3.}), angle);
  TetrahedralMesh turned = mesh;
  for (Point<3> &x : turned.vertices)
    x = Point<3>(turn * x);
  for (const Solid &solid : {bond_based(powers[0], reach), state_based(powers[0], reach / 2, 3)})
    for (const bool is_continuous : {true, false})
    {
      constexpr std::size_t n_rows = 3;
      const auto matrix = exact_rows(space_of(mesh, is_continuous), solid, n_rows),
                 of_turned = exact_rows(space_of(turned, is_continuous), solid, n_rows);
      std::vector<Blocks> rows;
      double worst = 0;
      for (std::size_t node = 0; node < n_rows; ++node)
      {
        rows.push_back(blocks(matrix, node));
        const Blocks others = blocks(of_turned, node);
        for (const auto &[other, block] : rows.back())
        {
          const auto found = others.find(other); // all may cancel
          worst = std::max(worst, (turn * block * transpose(turn) -
                                   (found == others.end() ? Block() : found->second))
                                      .norm());
        }
      }
      EXPECT_LT(worst / rows[0].at(0)[0][0], 1e-12);
      for (unsigned int i = 0; i < n_rows; ++i)
        for (unsigned int j = 0; j < n_rows; ++j)
          EXPECT_TRUE(rows[i].at(j) == Block(transpose(rows[j].at(i)))) << i << j;
    }
}

TEST(TensorEntries, on_lattices_have_the_moments_of_the_local_limit_and_are_repeated)
{
  const double reach = 1.4;
  const geometry::CubeLattice lattice({{{Point<3>(), Point<3>(3, 3, 3)}}, {}}, 1);
  const TetrahedralSpace space =
      space_of(geometry::six_per_cube(lattice, geometry::layers_within(reach, 1)), true);
  for (const Solid &solid : solids(reach))
  {
    const auto all = exact_rows(space, solid, space.n_free(), 1),
               repeated =
                   RepeatedRows(solid.bonds, 1, true, FaceRule::exact(), nullptr, solid.dilatation)
                       .on(space, lattice);
    EXPECT_LT(difference(repeated, all), 1e-12);
    EXPECT_LT(difference(all, repeated), 1e-12);
    dealii::Tensor<4, 3> second; // -½ Σ A_ab ξ_c ξ_d
    for (const auto &[node, block] : blocks(repeated, 0))
    {
      const dealii::Tensor<1, 3> xi = space.support(node) - space.support(0);
      second -= .5 * outer_product(block, outer_product(xi, xi));
    }
    double mu = solid.bonds.limit().mu, lambda = solid.bonds.limit().lambda;
    if (solid.dilatation)
    {
      mu = solid.dilatation->material({}).mu;
      lambda = solid.dilatation->material({}).lambda;
    }
    const auto same = [](unsigned int a, unsigned int b) { return a == b ? 1. : 0.; };
    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int b = 0; b < 3; ++b)
        for (unsigned int c = 0; c < 3; ++c)
          for (unsigned int d = 0; d < 3; ++d)
            EXPECT_NEAR(second[a][b][c][d] / mu,
                        same(a, b) * same(c, d) +
                            (lambda + mu) / mu * .5 *
                                (same(a, c) * same(b, d) + same(a, d) * same(b, c)),
                        1e-11);
  }
}

TEST(TensorEntries, have_potentials_that_are_integrals_of_both_parts)
{
  const dealii::QGauss<1> rule(96);
  const auto integral = [&rule](double from, const auto &f)
  {
    double sum = 0;
    for (unsigned int k = 0; k < rule.size(); ++k)
      sum += (1 - from) * rule.weight(k) * f(from + (1 - from) * rule.point(k)[0]);
    return sum;
  };
  std::vector<RadialProfile> profiles = all_profiles();
  profiles.push_back(physics::kernel_type("bond-tensor gaussian").make({{}, 0, .5}));
  for (const RadialProfile &profile : profiles)
  {
    const auto q = [&](double t)
    { return integral(t, [&profile](double s) { return profile(s) / s; }); };
    const auto w = [&](double t) { return profile(t) - 3 * q(t); };
    const SolidKernel parts({Structure::tensor, profile, 1, 1});
    for (const auto kind : {FacePotential::Kind::harmonic, FacePotential::Kind::biharmonic})
      for (const double r : {.05, .3, .7})
        for (unsigned int part = 0; part < 2; ++part)
        {
          const auto power = [&](double x)
          { return kind == FacePotential::Kind::harmonic ? x : x * x * x / 6; };
          const double expected =
              integral(r, [&](double t) { return t * (part == 0 ? q(t) : w(t)) * power(t - r); }) /
              r;
          const double square = r * r;
          double value = 0;
          FacePotential(parts.parts[part], kind).values(&square, &value, 1);
          EXPECT_NEAR(value, expected, FacePotential::has_power_parts(profile) ? 2e-13 : 1e-11)
              << r << " " << part;
        }
  }
}

TEST(TensorEntries, are_refused_for_tables_and_where_they_are_not_integrable)
{
  const auto refused = [](const RadialProfile &profile) {
    return FacePotential::refuse({Structure::tensor, profile, 1, 1});
  };
  for (const RadialProfile &profile : all_profiles())
    EXPECT_EQ(refused(profile), "");
  EXPECT_NE(refused(RadialProfile::table({{0, 1}, {.5, 1}, {1, 0}})).find("not for tables"),
            std::string::npos);
  EXPECT_NE(refused({{1, -2}}).find("at most 1/r"), std::string::npos);
}
