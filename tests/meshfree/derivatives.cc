// Rules that fit derivatives to values at nodes: PDDO and GMLS.
#include "base/error.h"
#include "geometry/node_cells_in_space.h"
#include "meshfree/rules/families.h"
#include "meshfree/rules/rules.h"
#include "scene/problem.h"
#include "tests/meshfree/lattice_rules.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace plumbline;
using namespace plumbline::meshfree;

namespace
{
  template <int dim>
  NeighbourhoodQuadrature<dim> make_rule(const std::string &name, const Kernel<dim> &kernel)
  {
    if constexpr (dim == 2)
      return find_rule(name, "rule").in_plane(kernel);
    else
      return find_rule(name, "rule").in_space(kernel);
  }

  template <int dim>
  double monomial(const Point<dim> &s, const Exponents<dim> &alpha)
  {
    double value = 1;
    for (unsigned int d = 0; d < dim; ++d)
      value *= std::pow(s[d], alpha[d]);
    return value;
  }

  /// As published: PDDO has the Gaussian and the areas, GMLS (1 - r/δ)^4.
  double omega(const std::string &rule, double r_over_horizon, double area)
  {
    return rule == "PDDO" ? area * std::exp(-4 * r_over_horizon * r_over_horizon)
                          : std::pow(1 - r_over_horizon, 4);
  }

  /// The coefficients w C by the published functions g^p: for each p, a system with the Gram matrix
  /// of all monomials up to degree 2, the node itself in its sums.
  template <int dim>
  std::vector<double> published_coefficients(const std::string &rule, const Kernel<dim> &kernel,
                                             const std::vector<Bond<dim>> &bonds, double own_area)
  {
    const auto basis = exponents<dim>(0, 2);
    const auto n = static_cast<Eigen::Index>(basis.size());
    const double horizon = kernel.horizon();
    const auto values = [&](const Point<dim> &xi)
    {
      Eigen::VectorXd v(n);
      for (Eigen::Index q = 0; q < n; ++q)
        v[q] = monomial<dim>(xi / horizon, basis[q]);
      return v;
    };
    const Point<dim> here;
    Eigen::MatrixXd gram = omega(rule, 0, own_area) * values(here) * values(here).transpose();
    for (const Bond<dim> &bond : bonds)
      gram += omega(rule, bond.xi.norm() / horizon, bond.area) * values(bond.xi) *
              values(bond.xi).transpose();
    // ∂^p = p! δ^-|p| times the coefficient of (ξ/δ)^p; the local limit has M_p / p! of it
    Eigen::VectorXd limit = Eigen::VectorXd::Zero(n);
    for (Eigen::Index p = 1; p < n; ++p)
      limit[p] = kernel.moment(basis[p]) / std::pow(horizon, order(basis[p]));
    const Eigen::VectorXd a = gram.fullPivLu().solve(limit);
    std::vector<double> result;
    for (const Bond<dim> &bond : bonds)
      result.push_back(omega(rule, bond.xi.norm() / horizon, bond.area) * a.dot(values(bond.xi)));
    return result;
  }

  template <int dim>
  void expect_published(const std::string &rule, const Kernel<dim> &kernel,
                        const std::vector<Bond<dim>> &bonds, double own_area)
  {
    const auto expected = published_coefficients(rule, kernel, bonds, own_area);
    double largest = 0;
    for (const double one : expected)
      largest = std::max(largest, std::abs(one));
    for (std::size_t j = 0; j < bonds.size(); ++j)
      ASSERT_NEAR(kernel_value(kernel, bonds[j], 0, 0) * bonds[j].weight, expected[j],
                  1e-11 * largest)
          << rule << ", " << bonds[j].xi;
    // L_h u of all quadratics is that of the local limit
    for (const auto &alpha : exponents<dim>(1, 2))
    {
      double sum = 0;
      for (const Bond<dim> &bond : bonds)
        sum += kernel_value(kernel, bond, 0, 0) * bond.weight *
               monomial<dim>(bond.xi / kernel.horizon(), alpha);
      EXPECT_NEAR(sum, kernel.moment(alpha) / std::pow(kernel.horizon(), order(alpha)),
                  1e-12 * std::pow(kernel.horizon(), -2))
          << rule;
    }
  }

  template <int dim>
  void expect_published(const std::string &rule, const Kernel<dim> &kernel,
                        const geometry::NodeCells<dim> &cells)
  {
    const Families<dim> families(make_rule(rule, kernel), kernel, cells, Backend::fast);
    Family<dim> family;
    for (std::size_t i = 0; i < std::min<std::size_t>(families.size(), 30); ++i)
    {
      families.make(i, family);
      expect_published(rule, kernel, family.bonds, cells.area[i]);
    }
  }

  /// The least eigenvalue over all waves but the constant, times h², on a grid of 41² of them.
  double least_eigenvalue(const std::string &rule, double m)
  {
    const auto kernel = scalar_kernel<2>(m, "constant");
    const auto bonds = lattice_bonds(make_rule(rule, kernel), kernel, h, Backend::fast);
    double least = 1e300;
    for (int a = 0; a <= 40; ++a)
      for (int b = a == 0 ? 1 : 0; b <= 40; ++b)
      {
        double value = 0;
        for (const Bond<2> &bond : bonds.family)
          value += kernel_value(kernel, bond, 0, 0) * bond.weight *
                   (1 - std::cos(M_PI / 40 / h * (a * bond.xi[0] + b * bond.xi[1])));
        least = std::min(least, value * h * h);
      }
    return least;
  }
} // namespace

TEST(FittedDerivatives, are_those_of_the_published_functions_on_lattices)
{
  for (const std::string rule : {"PDDO", "GMLS"})
    for (const std::string type : {"constant", "linear-decay", "1/r"})
      for (const double m : {2.3, 3., 4.7})
      {
        const auto plane = scalar_kernel<2>(m, type);
        expect_published(rule, plane,
                         lattice_bonds(make_rule(rule, plane), plane, h, Backend::fast).family,
                         h * h);
        const auto space = scalar_kernel<3>(m, type);
        expect_published(rule, space,
                         lattice_bonds(make_rule(rule, space), space, h, Backend::fast).family,
                         h * h * h);
      }
}

TEST(FittedDerivatives, are_those_of_the_published_functions_on_scattered_nodes)
{
  const auto scene = scene::parse_scene(
      "scattered.prm",
      "subsection Domain\n set mesh = squares\nend\nsubsection Problem\n set solution = "
      "x\nend\nsubsection Methods\n set perturbation = .3\n set names = FA\nend\n"
      "subsection Study\n set norms = nodal Linf\nend\n");
  const auto problem = scene::make_problem(scene, 0, {.125, .375});
  const geometry::CubeLattice cube{{{{{0, 0, 0}, {3 * h, 3 * h, 3 * h}}}, {}}, h};
  const auto cells = voronoi_cells(lattice_nodes(cube, 4, .3, 11), cube, 3 * h);
  for (const std::string rule : {"PDDO", "GMLS"})
  {
    expect_published(rule, problem.kernel, *problem.cells());
    expect_published(rule, scalar_kernel<3>(2.7), cells);
  }
}

// With five nodes there is one formula that is exact for quadratics.
TEST(FittedDerivatives, of_four_neighbours_are_central_differences)
{
  const auto kernel = scalar_kernel<2>(1.3, "constant");
  for (const std::string rule : {"PDDO", "GMLS", "GFD"})
  {
    const auto bonds = lattice_bonds(make_rule(rule, kernel), kernel, h, Backend::fast).family;
    ASSERT_EQ(bonds.size(), 4u);
    for (const Bond<2> &bond : bonds)
      EXPECT_NEAR(kernel_value(kernel, bond, 0, 0) * bond.weight * h * h, .5, 1e-12) << rule;
  }
}

// -ĝ(k), the symbol for small h, tends to 0 for short waves: the coefficients and the node's own
// add up to 0. The number is from an independent program (dense solve in another language).
TEST(FittedDerivatives, of_short_waves_are_unstable_for_pddo_and_stable_for_gmls_and_gfd)
{
  EXPECT_GT(least_eigenvalue("PDDO", 2), 0);
  EXPECT_NEAR(least_eigenvalue("PDDO", 3), -.013904830384, 1e-11);
  for (const double m : {3., 4., 5., 6.})
  {
    EXPECT_LT(least_eigenvalue("PDDO", m), 0) << m;
    EXPECT_GT(least_eigenvalue("GMLS", m), 0) << m;
    EXPECT_GT(least_eigenvalue("GFD", m), 0) << m;
  }
  const auto ratio = [](const std::string &rule, double m)
  {
    const auto kernel = scalar_kernel<2>(m, "constant");
    return smallest_ratio(lattice_bonds(make_rule(rule, kernel), kernel, h, Backend::fast));
  };
  EXPECT_GT(ratio("PDDO", 2), 0);
  EXPECT_LT(ratio("PDDO", 3), -1);
  EXPECT_GT(ratio("GFD", 3), 0);
}

TEST(FittedDerivatives, have_no_bond_where_omega_or_the_kernel_vanishes)
{
  const auto n_bonds = [](const std::string &rule, const std::string &type)
  {
    const auto kernel = scalar_kernel<2>(3, type);
    return lattice_bonds(make_rule(rule, kernel), kernel, h, Backend::fast).family.size();
  };
  EXPECT_EQ(n_bonds("PDDO", "constant"), 28u);
  EXPECT_EQ(n_bonds("GMLS", "constant"), 24u); // four nodes lie on the circle
  EXPECT_EQ(n_bonds("PDDO", "linear-decay"), 24u);
}

TEST(FittedDerivatives, refuse_bond_tensors)
{
  for (const std::string rule : {"PDDO", "GMLS"})
    try
    {
      make_rule(rule, tensor_kernel<2>(3));
      FAIL() << rule;
    }
    catch (const InputError &error)
    {
      for (const std::string part : {rule.c_str(), "scalar kernels only", "GFD"})
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}
