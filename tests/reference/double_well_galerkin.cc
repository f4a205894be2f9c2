#include "reference/lattice/double_well_galerkin.h"

#include "analysis/integrate.h"
#include "base/error.h"
#include "reference/lattice/torus_force.h"

#include <deal.II/base/quadrature_lib.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

using namespace plumbline;
using physics::DoubleWell;
using reference::DoubleWellGalerkin;
using reference::TorusForce;

namespace
{
  using Vector = std::vector<double>;
  const std::vector<physics::PowerTerm> constant = {{1, 0}}, decaying = {{1, 0}, {-1, 1}};

  Vector field(std::size_t n, double amplitude)
  {
    Vector u(n);
    for (std::size_t i = 0; i < n; ++i)
      u[i] = amplitude * std::sin(1. + static_cast<double>(i * i % 37));
    return u;
  }

  physics::WellPotential rational()
  {
    return {"Material/potential", "r/(1 + r)"};
  }

  template <int dim>
  void expect_gradient(const DoubleWellGalerkin<dim> &space)
  {
    const double step = 1e-5;
    const Vector u = field(space.size(), .15);
    Vector r;
    space.residual(u, r);
    for (std::size_t i = 0; i < u.size(); i += 7)
    {
      Vector plus = u, minus = u;
      plus[i] += step;
      minus[i] -= step;
      EXPECT_NEAR(r[i], -(space.energy(plus) - space.energy(minus)) / (2 * step), 1e-8);
    }
  }

  /// .3 sin 2πx at rest moves until .5 from its projection; the errors in L2 of u and v on n
  /// intervals, added.
  double line_error(int n, unsigned int degree)
  {
    const reference::AxisShapes shapes(true, degree);
    const dealii::QGauss<1> gauss(degree + 4);
    const unsigned int n_exact = 128;
    const DoubleWell law(1, decaying, 1, 1, .1);
    const auto &scheme = analysis::scheme("Blanes-Moan");
    const auto wave = [](double x) { return .3 * std::sin(2 * M_PI * x); };
    analysis::State exact{{}, Vector(n_exact), 0};
    for (unsigned int i = 0; i < n_exact; ++i)
      exact.u.push_back(wave(static_cast<double>(i) / n_exact));
    const DoubleWellGalerkin<1> space(law, 1. / n, {n, 1}, degree + 2, degree);
    analysis::State state{Vector(space.size()), Vector(space.size()), 0};
    for (int i = 0; i < n; ++i)
      for (unsigned int q = 0; q < gauss.size(); ++q)
        for (unsigned int a = 0; a <= degree; ++a)
          state.u[(i * degree + a) % space.size()] += gauss.weight(q) / n *
                                                      wave((i + gauss.point(q)[0]) / n) *
                                                      shapes.value(a, gauss.point(q)[0]);
    space.apply_mass(state.u, -1);
    const TorusForce<1> torus(law, n_exact, 1, 20);
    analysis::integrate({n_exact, [&](const Vector &u, double, Vector &a) { torus.force(u, a); }},
                        scheme, {.0025}, .5, exact);
    analysis::integrate(
        {space.size(), [&](const Vector &u, double, Vector &a) { space.acceleration(u, a); }},
        scheme, {.0025}, .5, state);
    double of_u = 0, of_v = 0;
    for (int i = 0; i < n; ++i)
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const double s = gauss.point(q)[0];
        const auto square = [&](const Vector &nodal, const Vector &wanted)
        {
          double difference = -torus.interpolate(wanted.data(), {(i + s) / n});
          for (unsigned int a = 0; a <= degree; ++a)
            difference += shapes.value(a, s) * nodal[(i * degree + a) % nodal.size()];
          return gauss.weight(q) / n * difference * difference;
        };
        of_u += square(state.u, exact.u);
        of_v += square(state.v, exact.v);
      }
    return std::sqrt(of_u) + std::sqrt(of_v);
  }
} // namespace

TEST(DoubleWellGalerkin, residual_is_the_gradient_of_the_energy)
{
  expect_gradient(DoubleWellGalerkin<1>({1, constant, 1.3, 2.1, .23}, .1, {10, 1}));
  expect_gradient(DoubleWellGalerkin<2>({2, decaying, 1.3, 2.1, .23}, .1, {5, 7}, 2));
  expect_gradient(DoubleWellGalerkin<1>({1, constant, 1.3, 2.1, .23}, .1, {10, 1}, 3, 2));
  expect_gradient(DoubleWellGalerkin<1>({1, constant, 1.3, 2.1, .23, rational()}, .1, {10, 1}));
  expect_gradient(DoubleWellGalerkin<2>({2, decaying, 1.3, 2.1, .23, rational()}, .1, {5, 7}, 2));
  expect_gradient(DoubleWellGalerkin<2>({2, decaying, 1.3, 2.1, .23}, .1, {5, 4}, 2, 2));
}

TEST(DoubleWellGalerkin, tangent_is_the_derivative_of_the_residual)
{
  const auto expect = [](const auto &space)
  {
    const double step = 1e-5;
    const Vector u = field(space.size(), .25), v = field(space.size() + 3, .4);
    Vector along(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(space.size())), plus = u,
                                                                                    minus = u;
    analysis::add(plus, step, along);
    analysis::add(minus, -step, along);
    Vector found, at_plus, at_minus, other;
    space.tangent(u, along, found);
    space.residual(plus, at_plus);
    space.residual(minus, at_minus);
    for (std::size_t i = 0; i < u.size(); ++i)
      EXPECT_NEAR(found[i], (at_plus[i] - at_minus[i]) / (2 * step), 1e-7);
    space.tangent(u, u, other); // symmetric
    EXPECT_NEAR(analysis::dot(u, found), analysis::dot(along, other),
                1e-12 * analysis::norm(u) * analysis::norm(found));
  };
  expect(DoubleWellGalerkin<1>({1, constant, 1.3, 2.1, .23}, .1, {10, 1}));
  expect(DoubleWellGalerkin<2>({2, decaying, 1.3, 2.1, .23}, .1, {5, 7}, 2));
  expect(DoubleWellGalerkin<2>({2, decaying, 1.3, 2.1, .23}, .1, {5, 4}, 2, 2));
  expect(DoubleWellGalerkin<2>({2, decaying, 1.3, 2.1, .23, rational()}, .1, {5, 4}, 2, 2));
}

TEST(DoubleWellGalerkin, is_the_same_by_an_expression)
{
  const physics::WellPotential same("Material/potential", "1 - exp(-r)");
  const DoubleWellGalerkin<2> built_in({2, decaying, 1.3, 2.1, .23}, .1, {5, 4}, 2),
      by_expression({2, decaying, 1.3, 2.1, .23, same}, .1, {5, 4}, 2);
  const Vector u = field(built_in.size(), .25);
  Vector r, other;
  built_in.residual(u, r);
  by_expression.residual(u, other);
  for (std::size_t i = 0; i < r.size(); ++i)
    EXPECT_NEAR(other[i], r[i], 1e-13);
  EXPECT_NEAR(by_expression.energy(u), built_in.energy(u), 1e-13 * built_in.energy(u));
}

TEST(DoubleWellGalerkin, mass_is_the_square_of_its_root)
{
  for (const unsigned int degree : {1u, 2u, 3u})
    for (const bool is_lumped : {false, true})
    {
      const DoubleWellGalerkin<2> space({2, constant, 1, 1, .2}, .2, {5, 4}, 1, degree, is_lumped);
      const Vector x = field(space.size(), 1);
      Vector y = x, z = x;
      space.apply_mass(y, 1);
      space.apply_mass(z, .5);
      Vector once = z;
      space.apply_mass(z, .5);
      space.apply_mass(once, -.5);
      for (std::size_t i = 0; i < x.size(); ++i)
      {
        EXPECT_NEAR(z[i], y[i], 1e-15);
        EXPECT_NEAR(once[i], x[i], 1e-13);
      }
      // each component weighs the area of the torus
      Vector ones(space.size(), 1);
      space.apply_mass(ones, 1);
      EXPECT_NEAR(std::accumulate(ones.begin(), ones.end(), 0.), 2 * 5 * 4 * .04, 1e-13);
    }
}

TEST(DoubleWellGalerkin, inverse_mass_undoes_the_mass)
{
  const DoubleWellGalerkin<2> space({2, constant, 1, 1, .2}, .2, {5, 4}, 1);
  const Vector x = field(space.size(), 1);
  Vector y = x;
  space.apply_mass(y, 1);
  EXPECT_NEAR(y[27],
              .04 * (4. / 9 * x[27] + 1. / 9 * (x[26] + x[28] + x[22] + x[32]) +
                     1. / 36 * (x[21] + x[23] + x[31] + x[33])),
              1e-15);
  space.apply_mass(y, -1);
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_NEAR(y[i], x[i], 1e-13);
}

TEST(DoubleWellGalerkin, load_converges_fast_in_the_number_of_points)
{
  const DoubleWell law(1, decaying, 1, 1, .1);
  const int n = 20;
  Vector u(n), exact, r;
  for (int i = 0; i < n; ++i)
    u[i] = .3 * std::sin(2 * M_PI * i / n);
  DoubleWellGalerkin<1>(law, 1. / n, {n, 1}, 12).residual(u, exact);
  const auto error = [&](unsigned int n_points)
  {
    DoubleWellGalerkin<1>(law, 1. / n, {n, 1}, n_points).residual(u, r);
    analysis::add(r, -1, exact);
    return analysis::norm(r) / analysis::norm(exact);
  };
  EXPECT_NEAR(error(2), 2.7e-4, .2e-4);
  EXPECT_NEAR(error(3), 1.3e-6, .2e-6);
  EXPECT_LT(error(4), 5e-8);
}

TEST(DoubleWellGalerkin, converges_to_the_torus_without_a_mesh_at_the_rate_of_its_degree)
{
  // those of Q1 are numbers of an independent program
  const std::map<unsigned int, Vector> known = {{1, {1.77e-2, 3.36e-3, 7.83e-4, 1.94e-4}}, {2, {}}};
  for (const auto &[degree, errors] : known)
  {
    double before = line_error(10, degree);
    for (int level = 1; level < 4; ++level)
    {
      const int n = 10 << level;
      const double error = line_error(n, degree);
      if (level > 1) // the horizon holds two cells
      {
        EXPECT_NEAR(std::log2(before / error), degree + 1, .12) << degree << ' ' << n;
      }
      if (!errors.empty())
      {
        EXPECT_NEAR(error, errors[level], .005 * errors[level]);
      }
      before = error;
    }
    EXPECT_LT(before, degree == 1 ? 5e-4 : 5e-6);
  }
}

TEST(DoubleWellGalerkin, takes_thousands_of_exponentials_a_cell)
{
  const DoubleWell law(2, decaying, 1, 1, .2);
  const auto n_of = [&](int m)
  {
    const int n = 5 * m;
    return DoubleWellGalerkin<2>(law, 1. / n, {n, n}, 2).n_evaluations();
  };
  // half of the ball; an independent program, with pieces of its own, takes 9,216 for the whole
  EXPECT_NEAR(2. * static_cast<double>(n_of(4)), 9216, .02 * 9216);
  EXPECT_GT(n_of(8), 3 * n_of(4));
}

TEST(DoubleWellGalerkin, small_waves_see_the_consistent_mass_and_stiffness_of_the_ball)
{
  const DoubleWell law(2, constant, 1, 1, .2);
  const int n = 20;
  const DoubleWellGalerkin<2> space(law, 1. / n, {n, n}, 2);
  Vector u(space.size()), a;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
    {
      u[j * n + i] = 1e-6 * std::cos(2 * M_PI * i / n);
      u[n * n + j * n + i] = 1e-6 * std::cos(2 * M_PI * i / n);
    }
  space.acceleration(u, a);
  // 18.4823169 and 6.3259900 are those of ε = .2, k = 2π; Q1 is above by O(h²)
  EXPECT_NEAR(-a[0] / 1e-6, 18.4823169, .02 * 18.48);
  EXPECT_NEAR(-a[n * n] / 1e-6, 6.3259900, .02 * 6.326);
  EXPECT_GT(space.n_evaluations(), 1000u);
}

TEST(DoubleWellGalerkin, refuses_what_is_no_mesh)
{
  const DoubleWell law(2, constant, 1, 1, .2);
  EXPECT_THROW(DoubleWellGalerkin<2>(law, 0, {5, 5}), InputError);
  EXPECT_THROW(DoubleWellGalerkin<2>(law, .1, {1, 5}), InputError);
  EXPECT_THROW(DoubleWellGalerkin<2>(law, .1, {5, 5}, 0), InputError);
}
