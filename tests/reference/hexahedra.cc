// Entries on hexahedra: those of cubes against the lattice's, what they annihilate, and constants
// as sums over tetrahedra.
#include "reference/tetrahedra/hexahedra.h"

#include "reference/lattice/solid_stencil.h"
#include "reference/tetrahedra/assembly.h"
#include "tests/geometry/moved_hexahedra.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>

namespace
{
  using namespace plumbline;
  using namespace plumbline::reference;
  using dealii::Point;
  using Rows = std::vector<std::map<unsigned int, double>>;

  physics::Kernel<3> kernel_of(const std::string &type, double horizon)
  {
    return physics::Kernel<3>::with_diffusion(physics::kernel_type(type).profile, horizon, 1);
  }

  /// Unit cubes with moved vertices.
  TetrahedralSpace space_on(double side, int n_layers, double most, const TetrahedralShapes &shapes)
  {
    const geometry::CubeLattice lattice({{{Point<3>(), Point<3>(side, side, side)}}, {}}, 1);
    return {
        std::make_shared<const TetrahedralMesh>(tests::moved_hexahedra(lattice, n_layers, most)),
        shapes};
  }

  const TetrahedralShapes trilinear = TetrahedralShapes(true).on_hexahedra(),
                          constants = TetrahedralShapes(false).on_hexahedra();

  Rows rows_of(const algebra::CsrMatrix &matrix)
  {
    Rows rows(matrix.n_rows());
    for (std::size_t row = 0; row < rows.size(); ++row)
      for (std::size_t k = matrix.start[row]; k < matrix.start[row + 1]; ++k)
        rows[row][matrix.column[k]] = matrix.value[k];
    return rows;
  }

  /// The largest difference of the first row, which has all columns of the stencil, to it, relative
  /// to the diagonal.
  double difference(const TetrahedralSpace &space, const Rows &rows,
                    const algebra::Stencil &stencil)
  {
    double worst = 0;
    std::size_t n = 0;
    std::set<std::array<int, 3>> columns;
    for (const auto &[column, value] : rows[0])
    {
      std::array<int, 3> at{};
      for (unsigned int d = 0; d < 3; ++d)
        at[d] = static_cast<int>(std::lround(space.support(column)[d] - space.support(0)[d]));
      worst = std::max(worst, std::abs(value - stencil(0, 0, at[0], at[1], at[2])));
      columns.insert(at);
    }
    const double rounding = 1e-15 * stencil(0, 0, 0, 0, 0);
    stencil.for_each_offset(
        [&](int k1, int k2, int k3)
        {
          if (std::abs(stencil(0, 0, k1, k2, k3)) < rounding)
            return;
          ++n;
          EXPECT_EQ(columns.count({k1, k2, k3}), 1u) << k1 << ' ' << k2 << ' ' << k3;
        });
    EXPECT_GT(n, 50u);
    return worst / stencil(0, 0, 0, 0, 0);
  }

  /// Rows leave nothing of constants and, if asked for, linear fields.
  void expect_annihilation(const TetrahedralSpace &space, const Rows &rows, bool is_linear)
  {
    for (unsigned int row = 0; row < rows.size(); ++row)
    {
      double sum = 0;
      dealii::Tensor<1, 3> first;
      for (const auto &[column, value] : rows[row])
      {
        sum += value;
        first += value * (space.support(column) - space.support(row));
        if (column < rows.size())
        {
          EXPECT_EQ(value, rows[column].at(row));
        }
      }
      EXPECT_LT(std::abs(sum), 1e-12 * rows[row].at(row));
      if (is_linear)
      {
        EXPECT_LT(first.norm(), 1e-12 * rows[row].at(row));
      }
    }
  }
} // namespace

TEST(HexahedralEntries, of_cubes_are_those_of_the_lattice)
{
  for (const std::string type : {"constant", "1/r"})
    for (const double horizon : {1.2, 1.05}) // the second reaches cubes two away by a twentieth
    {
      const auto kernel = kernel_of(type, horizon);
      const TetrahedralSpace space = space_on(2, 3, 0, trilinear);
      ASSERT_EQ(space.n_free(), 1u);
      const auto stencil = galerkin_stencil(kernel, 1, AxisShapes(true, 1));
      double before = 1;
      for (const unsigned int refinement : {0U, 1U})
      {
        const double error = difference(
            space, rows_of(assemble_on_hexahedra(space, kernel, 1, HexahedralRule(refinement))),
            stencil);
        RecordProperty(type + std::to_string(refinement), std::to_string(1e6 * error) + "e-6");
        EXPECT_GT(error, 1e-5); // of a rule
        EXPECT_LT(error, before) << type << refinement;
        before = error;
      }
      EXPECT_LT(before, 2e-3) << type;
    }
}

TEST(HexahedralEntries, leave_nothing_of_linear_fields_whatever_the_rule)
{
  const TetrahedralSpace space = space_on(3, 2, .2, trilinear);
  ASSERT_EQ(space.n_free(), 8u);
  for (const std::string type : {"constant", "1/r"})
    for (const unsigned int refinement : {0U, 1U})
      expect_annihilation(space,
                          rows_of(assemble_on_hexahedra(space, kernel_of(type, 1.2), space.n_free(),
                                                        HexahedralRule(refinement))),
                          true);
}

TEST(HexahedralEntries, of_constants_are_exact)
{
  const auto kernel = kernel_of("constant", 1.5);
  FaceRule rule = FaceRule::exact();
  rule.spacing = 1;
  const TetrahedralSpace space = space_on(1, 2, 0, constants);
  ASSERT_EQ(space.n_free(), 1u);
  EXPECT_LT(difference(space, rows_of(assemble_by_faces(space, kernel, 1, rule)),
                       galerkin_stencil(kernel, 1, AxisShapes(false, 0))),
            1e-11);
}

TEST(HexahedralEntries, of_constants_are_sums_over_tetrahedra)
{
  const auto kernel = kernel_of("linear-decay", 1.2);
  const TetrahedralSpace space = space_on(2, 2, .2, constants),
                         cut(std::make_shared<const TetrahedralMesh>(space.mesh()), false);
  FaceRule rule = FaceRule::exact();
  rule.tolerance = 1e-12;
  const Rows rows = rows_of(assemble_by_faces(space, kernel, space.n_free(), rule)),
             parts = rows_of(assemble_by_faces(cut, kernel, cut.n_free(), rule));
  ASSERT_EQ(rows.size(), 8u);
  ASSERT_EQ(parts.size(), 48u);
  expect_annihilation(space, rows, false);
  std::map<unsigned int, unsigned int> hexahedron; // of unknowns on tetrahedra
  for (std::size_t cell = 0; cell < cut.mesh().cells.size(); ++cell)
    hexahedron[cut.dof(cell, 0)] = space.dof(cell, 0);
  Rows sums(rows.size());
  for (unsigned int row = 0; row < parts.size(); ++row)
    for (const auto &[column, value] : parts[row])
      sums[hexahedron.at(row)][hexahedron.at(column)] += value;
  for (unsigned int row = 0; row < rows.size(); ++row)
    for (const auto &[column, value] : sums[row])
    {
      const auto found = rows[row].find(column);
      EXPECT_NEAR(value, found == rows[row].end() ? 0 : found->second, 1e-11 * rows[row].at(row));
    }
}
