// Bodies with free surfaces and bonds with factors on tetrahedra: energies of linear fields against
// integrals over all bonds from entries of constants for other kernels, rigid motions, and what
// becomes of them where factors are one and the surface is far away.
#include "reference/tetrahedra/bond_factors.h"
#include "reference/tetrahedra/jump_assembly.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

namespace
{
  using namespace plumbline;
  using namespace plumbline::reference;
  using dealii::Point;
  using physics::Structure;

  constexpr double horizon = 1.3;

  /// Cubes of side 1 with moved vertices; group 1 where x is beyond the middle.
  std::shared_ptr<const TetrahedralMesh> mesh_of_cubes(double side, int n_layers)
  {
    TetrahedralMesh mesh =
        geometry::six_per_cube({{{{Point<3>(), Point<3>(side, side, side)}}, {}}, 1}, n_layers);
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    {
      double x = 0;
      for (const unsigned int vertex : mesh.cells[cell])
        x += mesh.vertices[vertex][0] / 4;
      mesh.group.push_back(x > side / 2 ? 1 : 0);
    }
    mesh.groups = {"omega_a", "omega_b"};
    std::mt19937 random(5);
    for (Point<3> &x : mesh.vertices)
      for (unsigned int d = 0; d < 3; ++d)
        x[d] += .2 * (2 * (random() / 4294967296.) - 1);
    return std::make_shared<const TetrahedralMesh>(mesh);
  }

  /// γ = r^exponent, or with ê⊗ê; a constant of 1.
  physics::Kernel<3> power(int exponent, Structure structure)
  {
    return {structure, physics::RadialProfile({{1., exponent}}), horizon, 1};
  }

  struct Body
  {
    explicit Body(const physics::Kernel<3> &kernel,
                  std::shared_ptr<const TetrahedralMesh> tetrahedra = mesh_of_cubes(2, 0),
                  std::vector<double> of_group = {1, 5})
        : mesh(std::move(tetrahedra)), problem{geometry::CubeLattice(
                                                   {{{Point<3>(), Point<3>(1, 1, 1)}}, {}}, 1),
                                               kernel}
    {
      problem.factors = problem::GroupFactors{std::move(of_group), physics::Mean::harmonic};
      problem.is_free = true;
    }

    BondFactors factors() const { return {problem, *mesh}; }
    unsigned int n() const { return problem.n_components; }

    /// Of P1, or of DGP1.
    algebra::CsrMatrix rows(bool is_continuous) const
    {
      FaceRule rule = FaceRule::exact();
      rule.tolerance = 1e-12;
      rule.of_jumps = 1e-6;
      const TetrahedralSpace broken(mesh, TetrahedralShapes::discontinuous_linear());
      const BondFactors all = factors();
      if (!is_continuous)
        return assemble_with_jumps(broken, problem.kernel, broken.n_free(), rule, nullptr, {},
                                   &all);
      return joined(
          {mesh, true}, broken, n(),
          assemble_interfaces(broken, problem.kernel, broken.n_free(), rule, nullptr, all));
    }

    algebra::CsrMatrix rows_of_constants() const
    {
      const TetrahedralSpace space(mesh, false);
      return assemble_by_faces(space, problem.kernel, space.n_free(), FaceRule::exact());
    }

    std::shared_ptr<const TetrahedralMesh> mesh;
    problem::Problem<3> problem;
  };

  TetrahedralSpace space_of(const Body &body, bool is_continuous)
  {
    return {body.mesh,
            is_continuous ? TetrahedralShapes(true) : TetrahedralShapes::discontinuous_linear()};
  }

  /// ½ Σ a ∬γ z_c z_d / r² over all pairs of cells, from the entries of constants.
  /// @param kernel  a bond tensor
  dealii::Tensor<2, 3> half_of_bonds(const physics::Kernel<3> &kernel)
  {
    const Body body(kernel);
    const TetrahedralSpace space(body.mesh, false);
    const algebra::CsrMatrix rows = body.rows_of_constants();
    const BondFactors factors = body.factors();
    std::vector<std::size_t> cell_of(space.n_dofs());
    for (std::size_t cell = 0; cell < body.mesh->cells.size(); ++cell)
      cell_of[space.dof(cell, 0)] = cell;
    const double m0 = 4 * M_PI * kernel.profile().moment(2) * std::pow(horizon, 3);
    dealii::Tensor<2, 3> sum;
    for (std::size_t row = 0; row < rows.n_rows(); ++row)
      for (std::size_t k = rows.start[row]; k < rows.start[row + 1]; ++k)
      {
        const std::size_t i = row / 3, j = rows.column[k] / 3;
        double bonds = -rows.value[k]; // those between two cells, or within one
        if (i == j && row % 3 == rows.column[k] % 3)
          bonds += m0 / 3 * geometry::determinant(*body.mesh, cell_of[i]) / 6;
        sum[row % 3][rows.column[k] % 3] += .5 * factors.between(cell_of[i], cell_of[j]) * bonds;
      }
    return sum;
  }
} // namespace

// A field u = g·x has the energy ½∬aγ (g·z)².
TEST(BondFactors, give_linear_fields_the_energy_of_all_bonds)
{
  const dealii::Tensor<1, 3> slope({.7, -1.1, .4});
  for (const int exponent : {0, -1})
  {
    const double expected = slope * (half_of_bonds(power(exponent + 2, Structure::tensor)) * slope);
    const Body body(power(exponent, Structure::scalar));
    for (const bool is_continuous : {true, false})
    {
      const TetrahedralSpace space = space_of(body, is_continuous);
      const algebra::CsrMatrix rows = body.rows(is_continuous);
      ASSERT_EQ(rows.n_rows(), space.n_dofs());
      // bonds are in horizons: γ z² = horizon² (z / horizon)²
      double energy = 0, largest = 0;
      for (std::size_t row = 0; row < rows.n_rows(); ++row)
      {
        double sum = 0;
        for (std::size_t k = rows.start[row]; k < rows.start[row + 1]; ++k)
        {
          energy += (slope * space.support(row)) * rows.value[k] *
                    (slope * space.support(rows.column[k])) / (horizon * horizon);
          sum += rows.value[k];
          largest = std::max(largest, std::abs(rows.value[k]));
        }
        EXPECT_NEAR(sum / largest, 0, 1e-13);
      }
      EXPECT_NEAR(energy / expected, 1, 2e-6) << exponent << " " << is_continuous;
    }
  }
}

// u = x stretches each bond by its length; rigid motions stretch none.
TEST(BondFactors, stretch_bonds_of_solids_and_leave_rigid_motions)
{
  const int exponent = -1;
  const double expected = trace(half_of_bonds(power(exponent + 2, Structure::tensor)));
  const Body body(power(exponent, Structure::tensor));
  for (const bool is_continuous : {true, false})
  {
    const TetrahedralSpace space = space_of(body, is_continuous);
    const algebra::CsrMatrix rows = body.rows(is_continuous);
    ASSERT_EQ(rows.n_rows(), 3 * space.n_dofs());
    double energy = 0, largest = 0, of_rotation = 0;
    for (std::size_t row = 0; row < rows.n_rows(); ++row)
    {
      double sum = 0, rotation = 0;
      std::array<double, 3> of_shift{};
      for (std::size_t k = rows.start[row]; k < rows.start[row + 1]; ++k)
      {
        const std::size_t column = rows.column[k];
        const Point<3> &x = space.support(column / 3);
        sum += rows.value[k] * x[column % 3];
        rotation += rows.value[k] * std::array<double, 3>{-x[1], x[0], 0}[column % 3];
        of_shift[column % 3] += rows.value[k];
        largest = std::max(largest, std::abs(rows.value[k]));
      }
      energy += space.support(row / 3)[row % 3] * sum / (horizon * horizon);
      of_rotation = std::max(of_rotation, std::abs(rotation));
      for (const double shift : of_shift)
        EXPECT_NEAR(shift / largest, 0, 1e-13);
    }
    EXPECT_NEAR(energy / expected, 1, 2e-6) << is_continuous;
    EXPECT_LT(of_rotation / largest, is_continuous ? 1e-5 : 4e-5); // functions of one cell
  }
}

TEST(BondFactors, of_one_value_and_a_far_surface_are_a_factor)
{
  constexpr double factor = 3;
  FaceRule rule = FaceRule::exact();
  rule.tolerance = 1e-12;
  for (const bool is_continuous : {true, false})
  {
    const Body body(power(-1, Structure::tensor), mesh_of_cubes(is_continuous ? 2 : 1, 2),
                    {factor, factor});
    const TetrahedralSpace space = space_of(body, is_continuous);
    algebra::CsrMatrix expected =
        assemble_by_faces(space, body.problem.kernel, space.n_free(), rule);
    ASSERT_GT(expected.n_rows(), 0u);
    for (double &value : expected.value)
      value *= factor;
    EXPECT_LT(difference(body.rows(is_continuous), expected), is_continuous ? 1e-11 : 1e-14);
  }
  const Body body(power(-1, Structure::tensor), mesh_of_cubes(1, 2), {factor, factor});
  const TetrahedralSpace constants(body.mesh, false);
  algebra::CsrMatrix rows = body.rows_of_constants(), expected = rows;
  set_factors_of_cells(body.factors(), constants, 3, rows);
  for (double &value : expected.value)
    value *= factor;
  EXPECT_LT(difference(rows, expected), 1e-13);
}

TEST(BondFactors, of_cells_are_those_of_their_groups_and_sums_of_finer_entries)
{
  const Body body(power(0, Structure::scalar));
  const TetrahedralSpace constants(body.mesh, false), linear = space_of(body, false);
  const algebra::CsrMatrix homogeneous = body.rows_of_constants();
  algebra::CsrMatrix rows = homogeneous;
  const BondFactors factors = body.factors();
  set_factors_of_cells(factors, constants, 1, rows);
  std::vector<std::size_t> cell_of(constants.n_dofs());
  for (std::size_t cell = 0; cell < body.mesh->cells.size(); ++cell)
    cell_of[constants.dof(cell, 0)] = cell;
  std::map<std::pair<std::size_t, std::size_t>, double> sums;
  const algebra::CsrMatrix of_linear = body.rows(false);
  for (std::size_t row = 0; row < of_linear.n_rows(); ++row)
    for (std::size_t k = of_linear.start[row]; k < of_linear.start[row + 1]; ++k)
      sums[{row / 4, of_linear.column[k] / 4}] += of_linear.value[k];
  constexpr double between = 2 / (1 + 1. / 5); // the harmonic mean of 1 and 5
  for (std::size_t row = 0; row < rows.n_rows(); ++row)
  {
    double sum = 0;
    double largest = 0;
    for (std::size_t k = rows.start[row]; k < rows.start[row + 1]; ++k)
      largest = std::max(largest, rows.value[k]);
    for (std::size_t k = rows.start[row]; k < rows.start[row + 1]; ++k)
    {
      const std::size_t column = rows.column[k];
      const unsigned int a = body.mesh->group[cell_of[row]], b = body.mesh->group[cell_of[column]];
      const double expected = a != b ? between : a == 0 ? 1 : 5;
      if (column != row)
        EXPECT_NEAR(rows.value[k], expected * homogeneous.value[k], 1e-14);
      EXPECT_NEAR((sums[{row, column}]), rows.value[k], 1e-5 * largest);
      sum += rows.value[k];
    }
    EXPECT_NEAR(sum, 0, 1e-13);
  }
}
