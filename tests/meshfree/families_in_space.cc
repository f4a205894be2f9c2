// The rules on scattered nodes in space.
#include "base/error.h"
#include "geometry/node_cells_in_space.h"
#include "meshfree/rules/families.h"
#include "meshfree/rules/rules.h"
#include "meshfree/scattered/operator.h"
#include "tests/meshfree/lattice_rules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace plumbline;
using namespace plumbline::meshfree;

namespace
{
  constexpr int n_layers = 6;

  geometry::CubeLattice cube()
  {
    return {{{{{0, 0, 0}, {4 * h, 4 * h, 4 * h}}}, {}}, h};
  }

  geometry::NodeCells<3> cells_of(double perturbation)
  {
    return voronoi_cells(lattice_nodes(cube(), n_layers, perturbation, 11), cube(),
                         (n_layers - 1) * h);
  }

  Families<3> make(const std::string &name, const Kernel<3> &kernel,
                   const geometry::NodeCells<3> &cells)
  {
    return {find_rule(name, "rule").in_space(kernel), kernel, cells, Backend::fast};
  }

  /// The largest |Σ C_ab w ξ^α - ∫ C_ab ξ^α| δ^(2 - |α|) over all families, 1 <= |α| <= degree.
  double moment_defect(const Families<3> &families, int degree)
  {
    const Kernel<3> &kernel = families.kernel();
    double worst = 0;
    Family<3> family;
    for (std::size_t i = 0; i < families.size(); ++i)
    {
      families.make(i, family);
      for (unsigned int a = 0; a < kernel.n_components(); ++a)
        for (unsigned int b = 0; b < kernel.n_components(); ++b)
          for (int p = 0; p <= degree; ++p)
            for (int q = 0; p + q <= degree; ++q)
              for (int r = p + q == 0 ? 1 : 0; p + q + r <= degree; ++r)
              {
                double defect = -kernel.moment({p, q, r}, a, b);
                for (const Bond<3> &bond : family.bonds)
                  defect += kernel_value(kernel, bond, a, b) * bond.weight *
                            std::pow(bond.xi[0], p) * std::pow(bond.xi[1], q) *
                            std::pow(bond.xi[2], r);
                worst =
                    std::max(worst, std::abs(defect) / std::pow(kernel.horizon(), p + q + r - 2));
              }
    }
    return worst;
  }
} // namespace

TEST(FamiliesInSpace, are_the_lattices_where_nodes_are_not_moved)
{
  const auto cells = cells_of(0);
  for (const Kernel<3> &kernel : {scalar_kernel<3>(2.7), tensor_kernel<3>(3)})
    for (const Rule &rule : rules())
    {
      if (!rule.in_space)
        continue;
      const auto lattice = lattice_bonds(rule.in_space(kernel), kernel, h, Backend::fast).family;
      const Families<3> families(rule.in_space(kernel), kernel, cells, Backend::fast);
      Family<3> family;
      for (const std::size_t i : {std::size_t{0}, families.size() / 2, families.size() - 1})
      {
        families.make(i, family);
        ASSERT_EQ(family.bonds.size(), lattice.size()) << rule.name;
        for (std::size_t k = 0; k < lattice.size(); ++k)
        {
          const auto twin = std::find_if(
              lattice.begin(), lattice.end(),
              [&](const Bond<3> &bond) { return bond.xi.distance(family.bonds[k].xi) < 1e-9 * h; });
          ASSERT_NE(twin, lattice.end()) << rule.name;
          EXPECT_NEAR(family.bonds[k].weight / (h * h * h), twin->weight / (h * h * h), 1e-9)
              << rule.name;
          EXPECT_LT(family.bonds[k].kernel_point.distance(twin->kernel_point) *
                        family.bonds[k].area,
                    1e-11 * std::pow(h, 4))
              << rule.name;
        }
      }
    }
}

TEST(FamiliesInSpace, partial_volumes_add_up_to_the_ball_without_the_nodes_own_cell)
{
  for (const double perturbation : {.1, .3, .49})
  {
    const auto cells = cells_of(perturbation);
    const auto families = make("PA-AC", scalar_kernel<3>(2.7), cells);
    Family<3> family;
    for (std::size_t i = 0; i < families.size(); ++i)
    {
      const geometry::SolidBall ball{cells.nodes[i], families.kernel().horizon()};
      double volume = 0;
      for (std::size_t p = cells.first_piece[i]; p < cells.first_piece[i + 1]; ++p)
        volume += geometry::intersect(ball, cells.pieces[p], 0).volume;
      families.make(i, family);
      for (const Bond<3> &bond : family.bonds)
        volume += bond.weight;
      EXPECT_NEAR(volume / (4 * M_PI / 3 * std::pow(ball.radius, 3)), 1, 1e-12) << perturbation;
    }
  }
}

TEST(FamiliesInSpace, recalibrated_meet_all_moments_of_their_degree)
{
  const auto cells = cells_of(.3);
  for (const Kernel<3> &kernel : {scalar_kernel<3>(3), tensor_kernel<3>(3)})
  {
    EXPECT_LT(moment_defect(make("IPA-AC-R2", kernel, cells), 2), 1e-11);
    EXPECT_GT(moment_defect(make("IPA-AC", kernel, cells), 2), .05);
    EXPECT_GT(moment_defect(make("FA", kernel, cells), 2), .05);
  }
  EXPECT_LT(moment_defect(make("IPA-AC-R4", scalar_kernel<3>(4), cells), 4), 1e-11);
  EXPECT_LT(moment_defect(make("OPT", tensor_kernel<3>(3), cells), 2), 1e-10);
  EXPECT_LT(moment_defect(make("GFD", scalar_kernel<3>(3), cells), 2), 1e-11);
  EXPECT_LT(moment_defect(make("GFD", tensor_kernel<3>(3), cells), 2), 1e-10);
}

// -∫ C (u(x+ξ) - u(x)) of a quadratic is the local operator's value.
TEST(FamiliesInSpace, of_recalibrated_weights_reproduce_quadratics)
{
  const auto cells = cells_of(.3);
  const auto u = [](const dealii::Point<3> &x)
  { return 1 + x[0] - 2 * x[2] + x[0] * x[0] + 3 * x[1] * x[2]; };
  const double exact = -1; // -Δu / 2 with ∫ C ξ_1² = 1
  const auto worst = [&](const std::string &rule)
  {
    const auto families = make(rule, scalar_kernel<3>(3), cells);
    const auto rows = bond_rows<3>(
        [&](std::size_t i, Family<3> &family) { families.make(i, family); }, families.kernel(), 1,
        {0, cells.n_free}, [](std::size_t, const Family<3> &, std::vector<double> &) {});
    double error = 0;
    for (std::size_t i = 0; i < cells.n_free; ++i)
    {
      double value = 0;
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
        value += rows.value[k] * u(cells.nodes[rows.column[k]]);
      error = std::max(error, std::abs(value - exact));
    }
    return error;
  };
  EXPECT_LT(worst("IPA-AC-R2"), 1e-9);
  EXPECT_GT(worst("PA-AC"), .05);
}

TEST(FamiliesInSpace, too_few_neighbours_are_named)
{
  const auto cells = cells_of(.3);
  const auto families = make("IPA-AC-R4", scalar_kernel<3>(1.1), cells);
  Family<3> family;
  try
  {
    for (std::size_t i = 0; i < families.size(); ++i)
      families.make(i, family);
    FAIL();
  }
  catch (const NumericalError &error)
  {
    for (const std::string part : {"at node ", "neighbours", "degree 4", "raise m"})
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << part << error.what();
  }
}
