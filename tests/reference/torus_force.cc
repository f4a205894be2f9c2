#include "reference/lattice/torus_force.h"

#include "analysis/integrate.h"
#include "base/error.h"
#include "physics/double_well_load.h"
#include "physics/double_well_stability.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using physics::DoubleWell;
using physics::PowerTerm;
using reference::TorusForce;

namespace
{
  using Vector = std::vector<double>;
  const std::vector<PowerTerm> constant = {{1, 0}}, decaying = {{1, 0}, {-1, 1}};

  /// u(1/8) at time .5 of u0 = .3 sin 2πx at rest, ε = .1.
  double motion_at_an_eighth(const std::vector<PowerTerm> &influence, unsigned int n,
                             unsigned int n_radii)
  {
    const TorusForce<1> force(DoubleWell(1, influence, 1, 1, .1), n, 1, n_radii);
    analysis::State state{Vector(n), Vector(n), 0};
    for (unsigned int i = 0; i < n; ++i)
      state.u[i] = .3 * std::sin(2 * M_PI * i / n);
    const analysis::Motion motion{n,
                                  [&](const Vector &u, double, Vector &a) { force.force(u, a); }};
    analysis::integrate(motion, analysis::scheme("Blanes-Moan"), {.5 / 400}, .5, state);
    return state.u[n / 8];
  }
} // namespace

TEST(TorusForce, of_a_smooth_motion_is_exact_to_round_off)
{
  EXPECT_NEAR(motion_at_an_eighth(decaying, 128, 20), -.034091384892, 6e-13);
  EXPECT_NEAR(motion_at_an_eighth(constant, 128, 20), -.205647113963, 6e-13);
  EXPECT_NEAR(motion_at_an_eighth(decaying, 256, 32), -.034091384892, 6e-13);
  EXPECT_NEAR(motion_at_an_eighth(constant, 256, 32), -.205647113963, 6e-13);
}

TEST(TorusForce, is_that_of_a_field_given_by_its_formula)
{
  struct Expected
  {
    physics::WellPotential shape;
    double coarse = 0, fine = 0; // errors of (10, 24) and (12, 32) points
  };
  // 1 - e^(-s) is entire, s/(1 + s) has a pole, at which s is -1
  const Expected all[] = {{{}, 1e-9, 1e-13}, {{"Material/potential", "r/(1 + r)"}, 4e-8, 1e-10}};
  for (const auto &[shape, coarse_bound, fine_bound] : all)
  {
    const DoubleWell law(2, decaying, 1.3, 2.1, .2, shape);
    const unsigned int n = 32;
    const double side = 1.5, wave = 2 * M_PI / side;
    const auto field = [&](const dealii::Point<2> &x)
    {
      return dealii::Tensor<1, 2>({.2 * std::sin(wave * x[0]) * std::cos(wave * x[1]),
                                   .1 * std::cos(wave * (x[0] - x[1]))});
    };
    const TorusForce<2> torus(law, n, side, 16, 48);
    const physics::WellForce<2> exact(law, 16, 48), coarse(law, 10, 24), fine(law);
    Vector u(torus.size()), f;
    const auto place = [&](std::size_t i)
    { return dealii::Point<2>(side * (i % n) / n, side * (i / n) / n); };
    for (std::size_t i = 0; i < n * n; ++i)
      for (unsigned int a = 0; a < 2; ++a)
        u[a * n * n + i] = field(place(i))[a];
    torus.force(u, f);
    double coarse_error = 0, fine_error = 0;
    for (const std::size_t i : {0, 5, 40, 77, 330, 777, 1023})
    {
      const auto value = exact(field, place(i));
      for (unsigned int a = 0; a < 2; ++a)
        EXPECT_NEAR(f[a * n * n + i], value[a], 1e-11);
      coarse_error = std::max(coarse_error, (coarse(field, place(i)) - value).norm());
      fine_error = std::max(fine_error, (fine(field, place(i)) - value).norm());
    }
    EXPECT_LT(coarse_error, coarse_bound);
    EXPECT_LT(fine_error, fine_bound);
    EXPECT_NEAR(torus.interpolate(u.data(), {.37, .81}), field({.37, .81})[0], 1e-13);
  }
}

TEST(TorusForce, is_the_gradient_of_the_energy)
{
  const DoubleWell law(2, constant, 1, 1, .3);
  const unsigned int n = 32;
  const TorusForce<2> torus(law, n, 1, 8, 16, {{{.3, .1}, {.1, -.2}}});
  Vector u(torus.size()), f;
  for (std::size_t i = 0; i < u.size(); ++i)
    u[i] = .1 * std::sin(2 * M_PI * (i % n) / n) * std::cos(2 * M_PI * (i / n + .1) / n);
  torus.force(u, f);
  const double cell = 1. / (n * n), step = 1e-4;
  for (const std::size_t i : {0, 17, 264, 1101, 1700})
  {
    Vector plus = u, minus = u;
    plus[i] += step;
    minus[i] -= step;
    EXPECT_NEAR(f[i], -(torus.energy(plus) - torus.energy(minus)) / (2 * step * cell), 1e-6);
  }
}

TEST(TorusForce, a_wave_on_uniform_strain_grows_as_its_symbol_says)
{
  // ε = .1, g = 4, J = 1, mode 6
  const DoubleWell law(1, constant, 1, 1, .1);
  const unsigned int n = 64;
  const TorusForce<1> force(law, n, 1, 24, 1, {{{4}}});
  const double rate = std::sqrt(-physics::wave_symbol(law, {4, 0, 0}, {12 * M_PI, 0}).xx);
  analysis::State state{Vector(n), Vector(n), 0};
  for (unsigned int i = 0; i < n; ++i)
  {
    state.u[i] = 1e-8 * std::cos(12 * M_PI * i / n);
    state.v[i] = rate * state.u[i];
  }
  const analysis::Motion motion{n, [&](const Vector &u, double, Vector &a) { force.force(u, a); }};
  const auto &scheme = analysis::scheme("symplectic Euler");
  analysis::integrate(motion, scheme, {.001}, .4, state);
  const double before = state.u[0];
  analysis::integrate(motion, scheme, {.001}, .6, state);
  const double observed = std::log(state.u[0] / before) / .2;
  EXPECT_NEAR(observed, rate, 1e-4 * rate);
  EXPECT_NEAR(observed, 2 / .001 * std::asinh(.0005 * rate), 5e-5); // what the scheme makes of it
}

TEST(TorusForce, refuses_what_is_no_torus)
{
  const DoubleWell law(1, constant, 1, 1, .1);
  EXPECT_THROW(TorusForce<1>(law, 9, 1, 4), InputError);
  EXPECT_THROW(TorusForce<1>(law, 8, 0, 4), InputError);
  EXPECT_THROW(TorusForce<1>(law, 8, 1, 0), InputError);
  EXPECT_THROW(physics::WellForce<1>(law, 0), InputError);
}
