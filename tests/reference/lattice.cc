#include "reference/geometry_check.h"
#include "reference/lattice/deal_field.h"
#include "reference/lattice/field.h"
#include "reference/lattice/stencil.h"
#include "scene/problem.h"
#include "tests/reference/stencil_moment.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::reference;
using geometry::Backend;
using geometry::Point;
using physics::Kernel;

namespace
{
  constexpr double horizon = .3, h = .1;

  Kernel<2> scalar_kernel(double delta = horizon, const std::string &type = "linear-decay")
  {
    return Kernel<2>::with_diffusion(physics::kernel_type(type).profile, delta, .5);
  }
  Kernel<2> tensor_kernel(double delta = horizon)
  {
    return Kernel<2>::with_bulk_modulus(physics::kernel_type("bond-tensor").profile, delta, 1);
  }

  scene::Scene make_scene(const std::string &kernel, const std::string &solution,
                          const std::string &more = "")
  {
    return scene::parse_scene("test.prm",
                              "subsection Kernel\n" + kernel +
                                  "\nend\nsubsection Problem\n set solution = " + solution +
                                  "\nend\nsubsection Methods\n set names = Q1\nend\n" + more);
  }
  const std::string scalar_text = "set type = linear-decay";
  const std::string tensor_text = "set type = bond-tensor\nset limit = Navier";
} // namespace

TEST(Correlations, of_hat_functions_are_cubic_splines_and_of_constants_are_hats)
{
  const Correlations hats(AxisShapes(true, 1)), boxes(AxisShapes(false, 0));
  EXPECT_NEAR(hats(0, 0, 0), 2. / 3, 1e-15);
  EXPECT_NEAR(hats(0, 0, 1), 1. / 6, 1e-15);
  EXPECT_NEAR(hats(0, 0, -.5), 23. / 48, 1e-15);
  EXPECT_NEAR(hats(0, 0, 2), 0, 1e-15);
  EXPECT_NEAR(boxes(0, 0, .25), .75, 1e-15);
  EXPECT_NEAR(boxes(0, 0, -1), 0, 1e-15);
}

TEST(Correlations, series_reproduce_them_and_partitions_of_unity_add_up)
{
  for (const bool is_continuous : {true, false})
    for (unsigned int degree = is_continuous ? 1 : 0; degree <= 3; ++degree)
    {
      const AxisShapes shapes(is_continuous, degree);
      const Correlations r(shapes);
      const auto n = static_cast<unsigned int>(shapes.families().size());
      std::vector<double> modes(r.n_modes());
      for (const double tau : {-1.7, -.9, -.2, .35, 1.1})
      {
        double total = 0;
        const int j = static_cast<int>(std::floor(tau));
        legendre(2 * (tau - j) - 1, r.n_modes(), modes.data());
        for (unsigned int s = 0; s < n; ++s)
          for (unsigned int t = 0; t < n; ++t)
          {
            double value = 0;
            if (const double *series = r.coefficients(s, t, j))
              for (unsigned int k = 0; k < r.n_modes(); ++k)
                value += series[k] * modes[k];
            EXPECT_NEAR(value, r(s, t, tau), 1e-14);
            // Σ over all cells and families of φ is 1
            for (int cell = -3; cell <= 3; ++cell)
              total += r(s, t, tau + cell);
          }
        EXPECT_NEAR(total, 1, 1e-14) << degree;
      }
    }
}

TEST(GalerkinStencil, of_a_table_tends_to_that_of_the_powers_it_is_sampled_from)
{
  const physics::RadialProfile powers({{1, 0}, {-2, 1}, {1, 2}});
  const auto stencil = [](const physics::RadialProfile &profile)
  {
    return galerkin_stencil(Kernel<2>(physics::Structure::scalar, profile, horizon, 1), h,
                            AxisShapes(true, 1), Backend::fast);
  };
  const auto exact = stencil(powers);
  double before = 0;
  for (const unsigned int n : {8u, 16u, 32u})
  {
    std::vector<std::array<double, 2>> rows;
    for (unsigned int i = 0; i <= n; ++i)
      rows.push_back({1. * i / n, powers(1. * i / n)});
    const auto entries = stencil(physics::RadialProfile::table(rows));
    double difference = 0;
    for (int k2 = -exact.reach(); k2 <= exact.reach(); ++k2)
      for (int k1 = -exact.reach(); k1 <= exact.reach(); ++k1)
        difference = std::max(difference, std::abs(entries(0, 0, k1, k2) - exact(0, 0, k1, k2)));
    if (before > 0)
    {
      EXPECT_NEAR(before / difference, 4, .3);
    }
    before = difference;
  }
  EXPECT_LT(before, 2e-3 * exact(0, 0, 0, 0));
}

TEST(GalerkinStencil, constants_are_in_the_kernel_and_second_moments_are_those_of_the_kernel)
{
  for (const double ratio : {1., 1.5, 2.5, 3., 5., 7.3})
  {
    const double delta = ratio * h;
    const auto scalar = scalar_kernel(delta);
    const auto stencil = galerkin_stencil(scalar, h, AxisShapes(true, 1), Backend::fast);
    const double size = stencil(0, 0, 0, 0);
    EXPECT_NEAR(stencil_moment(stencil, 0, 0, 0, 0), 0, 1e-14 * size);
    // Σ_k A(k) (k1 h)² = -h² ∫ C ξ_1²
    EXPECT_NEAR(stencil_moment(stencil, 0, 0, 2, 0) * h * h, -h * h * scalar.moment({2, 0}), 1e-13);
    EXPECT_NEAR(stencil_moment(stencil, 0, 0, 1, 1), 0, 1e-13 * size);

    const physics::RadialProfile table =
        physics::RadialProfile::table({{0, 2}, {.3, 1.5}, {.5, .2}, {1, .1}});
    for (const auto &profile : {physics::kernel_type("gaussian").make({{}, 0, .2, {}}), table})
    {
      const Kernel<2> kernel = Kernel<2>::with_diffusion(profile, delta, .5);
      const auto entries = galerkin_stencil(kernel, h, AxisShapes(true, 2), Backend::fast);
      double sum = 0;
      for (unsigned int s = 0; s < entries.n_blocks(); ++s)
        for (unsigned int t = 0; t < entries.n_blocks(); ++t)
          sum += stencil_moment(entries, s, t, 0, 0);
      EXPECT_NEAR(sum, 0, 1e-13 * entries(0, 0, 0, 0));
      EXPECT_NEAR(stencil_moment(galerkin_stencil(kernel, h, AxisShapes(true, 1), Backend::fast), 0,
                                 0, 2, 0) *
                      h * h,
                  -h * h, 1e-13);
    }

    const auto tensor = tensor_kernel(delta);
    const auto blocks = galerkin_stencil(tensor, h, AxisShapes(true, 1), Backend::fast);
    for (unsigned int a = 0; a < 2; ++a)
      for (unsigned int b = 0; b < 2; ++b)
      {
        EXPECT_NEAR(stencil_moment(blocks, a, b, 0, 0), 0, 1e-14 * blocks(0, 0, 0, 0));
        EXPECT_NEAR(stencil_moment(blocks, a, b, 2, 0), -tensor.moment({2, 0}, a, b), 1e-12);
        EXPECT_NEAR(stencil_moment(blocks, a, b, 1, 1), -tensor.moment({1, 1}, a, b), 1e-12);
      }
  }
}

TEST(GalerkinStencil, is_symmetric_for_every_space_and_kernel)
{
  for (const bool is_continuous : {true, false})
    for (unsigned int degree = is_continuous ? 1 : 0; degree <= 3; ++degree)
      for (const auto &kernel : {scalar_kernel(), scalar_kernel(.25, "1/r"), tensor_kernel()})
        EXPECT_LT(galerkin_stencil(kernel, h, AxisShapes(is_continuous, degree), Backend::fast)
                      .symmetry_defect(),
                  1e-14);
}

// A_k = -∫_cell |B(x) ∩ cell_k| c dx for piecewise constants and a constant kernel: the outer
// integral by brute force, the inner by the intersection areas, which share nothing with the
// correlation formula.
TEST(GalerkinStencil, agrees_with_brute_force_over_pairs_of_cells)
{
  const double delta = .23;
  const auto kernel = scalar_kernel(delta, "constant");
  const auto stencil = galerkin_stencil(kernel, h, AxisShapes(false, 0), Backend::fast);
  const dealii::QIterated<2> outer(dealii::QGauss<1>(4), 64);
  for (const auto &[k1, k2] : {std::pair<int, int>{1, 0}, {2, 0}, {2, 1}, {1, 2}, {2, 2}, {3, 0}})
  {
    const auto cell = geometry::square(Point<2>(k1 * h, k2 * h), h);
    double sum = 0;
    for (unsigned int q = 0; q < outer.size(); ++q)
      sum += outer.weight(q) *
             geometry::intersect({h * outer.point(q), delta}, geometry::view(cell)).area;
    EXPECT_NEAR(stencil(0, 0, k1, k2), -kernel.constant() * h * h * sum, 1e-8 * stencil(0, 0, 0, 0))
        << k1 << ' ' << k2;
  }
}

TEST(GalerkinStencil, exact_geometry_gives_the_same_entries)
{
  for (const double ratio : {2.5, 3.})
  {
    const auto kernel = tensor_kernel(ratio * h);
    const AxisShapes shapes(true, 2);
    const auto fast = galerkin_stencil(kernel, h, shapes, Backend::fast);
    const auto exact = galerkin_stencil(kernel, h, shapes, Backend::cgal);
    double worst = 0;
    for (unsigned int s = 0; s < fast.n_blocks(); ++s)
      for (unsigned int t = 0; t < fast.n_blocks(); ++t)
        for (int k2 = -fast.reach(); k2 <= fast.reach(); ++k2)
          for (int k1 = -fast.reach(); k1 <= fast.reach(); ++k1)
            worst = std::max(worst, std::abs(fast(s, t, k1, k2) - exact(s, t, k1, k2)));
    EXPECT_LT(worst, 1e-13 * fast(0, 0, 0, 0));
  }
}

TEST(GeometryCheck, finds_cut_cells_and_no_difference)
{
  const auto check = check_geometry(.3, .05, 20, 1);
  EXPECT_EQ(check.n_checked, 11u); // cells of a quadrant that a circle of radius 6 h enters
  EXPECT_LT(check.worst_difference, 1e-13);
}

namespace
{
  /// Degrees of freedom without a pattern.
  LatticeField some_field(const problem::Problem<2> &problem, const AxisShapes &shapes)
  {
    const auto nodes = free_nodes(*problem.lattice(), shapes.families(), problem.n_components);
    std::vector<double> values(static_cast<std::size_t>(nodes.n_blocks()) * (nodes.n[0] + 2) *
                               (nodes.n[1] + 2));
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = std::sin(1 + 7. * static_cast<double>(i * i % 1009));
    return {*problem.lattice(), shapes, problem.n_components, values};
  }
} // namespace

TEST(LatticeField, is_the_deal_ii_field_of_the_same_degrees_of_freedom)
{
  const auto scene = make_scene(tensor_text, "sin(2*x)*y, x*x + cos(y)",
                                "subsection Domain\n set holes = 0.4, 0.2 : 0.6, 0.6\nend\n");
  const auto problem = make_problem(scene, 0, {h, horizon});
  for (const auto &shapes :
       {AxisShapes(true, 1), AxisShapes(true, 3), AxisShapes(false, 0), AxisShapes(false, 2)})
  {
    const LatticeField field = some_field(problem, shapes);
    const DealField deal(field);
    const dealii::QGauss<2> quadrature(3);
    dealii::FEValues<2> values(deal.element, quadrature,
                               dealii::update_values | dealii::update_quadrature_points);
    std::vector<dealii::Vector<double>> u(quadrature.size(), dealii::Vector<double>(2));
    double worst = 0;
    for (const auto &cell : deal.dofs.active_cell_iterators())
    {
      values.reinit(cell);
      values.get_function_values(deal.values, u);
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        for (unsigned int c = 0; c < 2; ++c)
          worst = std::max(worst, std::abs(u[q][c] - field.value(values.quadrature_point(q), c)));
    }
    EXPECT_EQ(deal.triangulation.n_active_cells(), 100u - 8);
    constexpr double round_off = 1e-13; // of 16 terms up to 2, summed in another order
    EXPECT_LT(worst, round_off);
  }
}

TEST(LatticeField, averages_are_the_integrals_of_the_field)
{
  const auto scene = make_scene(scalar_text, "x^3*y^2 + y^4");
  const auto problem = make_problem(scene, 0, {h, horizon});
  const LatticeField field = some_field(problem, AxisShapes(true, 2));
  for (const bool at_vertices : {false, true})
  {
    const geometry::AxisSpecies nodes{at_vertices ? 0. : .5, at_vertices, 0};
    const auto cells = free_nodes(*problem.lattice(), {nodes}, 1);
    const auto averages = field.averages(cells);
    const dealii::QIterated<2> rule(dealii::QGauss<1>(3), 2);
    std::size_t index = 0;
    for (int j = 0; j < cells.n[1]; ++j)
      for (int i = 0; i < cells.n[0]; ++i)
        if (cells.free(0, i, j))
        {
          double mean = 0;
          const auto place = cells.place(0, i, j);
          for (unsigned int q = 0; q < rule.size(); ++q)
            mean += rule.weight(q) *
                    field.value(problem.lattice()->point(place[0] - .5 + rule.point(q)[0],
                                                         place[1] - .5 + rule.point(q)[1]),
                                0);
          EXPECT_NEAR(averages[index++], mean, 1e-14);
        }
    EXPECT_EQ(index, averages.size());
  }
}

// Beside the hole u = x; in its middle vertex, which its cells alone have, u is another number.
TEST(LatticeField, has_the_gradient_of_the_domain_on_the_side_of_a_hole)
{
  constexpr double size = .25;
  const geometry::Lattice lattice(
      {{{Point<2>(0, 0), Point<2>(1, 1)}}, {{Point<2>(.25, .25), Point<2>(.75, .75)}}}, size);
  const reference::AxisShapes shapes(true, 1);
  const int first = shapes.owner(0).shift; // from a cell to its lower vertex
  std::vector<double> values;
  for (int j = -1; j <= 4; ++j)
    for (int i = -1; i <= 4; ++i)
      values.push_back(i - first == 2 && j - first == 2 ? 100 : size * (i - first));
  const reference::LatticeField field(lattice, shapes, 1, values);
  for (const Point<2> &x : {Point<2>(.25, .5), Point<2>(.75, .4), Point<2>(.5, .25),
                            Point<2>(.4, .75), Point<2>(.1, .1), Point<2>(1, 1)})
  {
    const auto gradient = field.gradient(x, 0);
    EXPECT_NEAR(gradient[0], 1, 1e-13) << x;
    EXPECT_NEAR(gradient[1], 0, 1e-13) << x;
    EXPECT_NEAR(field.value(x, 0), x[0], 1e-14) << x;
  }
}
