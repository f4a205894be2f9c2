#include "analysis/integrate.h"

#include "analysis/amplification.h"
#include "analysis/critical_step.h"
#include "base/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace plumbline;
using namespace plumbline::analysis;

namespace
{
  /// Springs that harden: ü = -u - u³ + sin t.
  Motion springs(std::size_t n, double damping = 0)
  {
    return {n,
            [](const Vector &u, double t, Vector &a)
            {
              for (std::size_t i = 0; i < u.size(); ++i)
                a[i] = -(1. + static_cast<double>(i)) * u[i] - u[i] * u[i] * u[i] + std::sin(t);
            },
            [](const Vector &u, const Vector &v, Vector &out)
            {
              for (std::size_t i = 0; i < u.size(); ++i)
                out[i] = -(1. + static_cast<double>(i) + 3 * u[i] * u[i]) * v[i];
            },
            damping};
  }

  /// ü = -ω² u
  Motion oscillator(double omega)
  {
    return {1, [omega](const Vector &u, double, Vector &a) { a[0] = -omega * omega * u[0]; },
            [omega](const Vector &, const Vector &v, Vector &out)
            { out[0] = -omega * omega * v[0]; }};
  }

  double error_of(const Motion &motion, const std::string &name, double step)
  {
    State state{{.5, -.3, .2}, {0, .4, -.1}, .25}, exact = state;
    integrate(motion, scheme(name), {step}, 2.25, state);
    integrate(motion, scheme("Runge-Kutta"), {.5, {}, false, 1e-14}, 2.25, exact);
    add(state.u, -1, exact.u);
    add(state.v, -1, exact.v);
    return norm(state.u) + norm(state.v);
  }

  /// The slope of log error over log Δt by least squares.
  double fitted_order(const Motion &motion, const std::string &name)
  {
    double x = 0, y = 0, xx = 0, xy = 0;
    constexpr int n = 5;
    for (int i = 0; i < n; ++i)
    {
      const double step = .05 / (1 << i), a = std::log(step),
                   b = std::log(error_of(motion, name, step));
      x += a;
      y += b;
      xx += a * a;
      xy += a * b;
    }
    return (n * xy - x * y) / (n * xx - x * x);
  }

  std::string refusal(const Motion &motion, const std::string &name, const Stepping &stepping,
                      State state, double end = 1)
  {
    try
    {
      integrate(motion, scheme(name), stepping, end, state);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "accepted";
  }
} // namespace

TEST(Integrate, every_scheme_has_its_order)
{
  for (const double damping : {0., .7})
    for (const Scheme &one : schemes())
    {
      if (one.is_runge_kutta)
        continue;
      EXPECT_NEAR(fitted_order(springs(3, damping), one.name), one.order, .1)
          << one.name << " with damping " << damping;
    }
}

// Jha & Lipton 2018, doi:10.1137/17M1112236, (18)-(19) and Theorem 4
TEST(Integrate, schemes_with_theta_have_order_two_at_one_half_alone)
{
  for (const auto &[name, order] :
       {std::pair{"theta 0.5", 2}, std::pair{"theta 0.55", 1}, std::pair{"theta 0.75", 1},
        std::pair{"theta 1", 1}, std::pair{"theta 0.25", 1}, std::pair{"theta 0", 1}})
  {
    EXPECT_EQ(scheme(name).order, order) << name;
    EXPECT_NEAR(fitted_order(springs(3, 0), name), order, .15) << name;
  }
  for (const auto &[name, same] :
       {std::pair{"theta 0", "explicit Euler"}, std::pair{"theta 0.5", "trapezoidal"},
        std::pair{"theta 1", "implicit Euler"}})
    EXPECT_EQ(error_of(springs(3, .2), name, .05), error_of(springs(3, .2), same, .05)) << name;
  for (const char *const wrong :
       {"theta", "theta 1.1", "theta -0.1", "theta x", "theta 0.5 x", "theta0.5", "theta nan"})
    EXPECT_THROW(scheme(wrong), InputError) << wrong;
}

TEST(Integrate, schemes_with_theta_below_one_half_grow_with_every_step)
{
  EXPECT_EQ(stability_limit(scheme("theta 0.49")), 0);
  EXPECT_EQ(stability_limit(scheme("theta 0.5")), std::numeric_limits<double>::infinity());
  const State state{{1}, {0}, 0};
  EXPECT_NE(refusal(oscillator(2), "theta 0.3", {.1, 0.}, state).find("critical step 0 "),
            std::string::npos);
  EXPECT_EQ(refusal(oscillator(2), "theta 0.3", {.1, 0., true}, state), "accepted");
}

TEST(SpectralRadius, is_the_growth_of_motions_in_a_step)
{
  constexpr double rate = 3, step = .1;
  const Motion unstable{1, [](const Vector &u, double, Vector &a) { a[0] = rate * rate * u[0]; },
                        [](const Vector &, const Vector &v, Vector &out)
                        { out[0] = rate * rate * v[0]; }};
  for (const char *const name : {"implicit Euler", "trapezoidal", "theta 0.7", "explicit Euler",
                                 "symplectic Euler", "velocity Verlet", "Blanes-Moan"})
    for (const bool is_growing : {true, false})
    {
      // of oscillators the norm of many steps shows it
      const Motion motion = is_growing ? unstable : oscillator(rate);
      const double lambda = is_growing ? rate * rate : -rate * rate;
      std::vector<double> sizes;
      State state{{1}, {is_growing ? rate : 0}, 0};
      integrate(motion, scheme(name), {step, {}, true}, is_growing ? 10 : 100, state,
                [&](const State &now) { sizes.push_back(std::hypot(now.u[0], now.v[0] / rate)); });
      const std::size_t n = sizes.size(), first = n / 5 - 1;
      const double found = std::pow(sizes[n - 1] / sizes[first],
                                    1. / static_cast<double>(n - 1 - first)),
                   expected = spectral_radius(scheme(name), lambda, step);
      EXPECT_NEAR(found, expected, is_growing ? 1e-6 : 1e-3) << name << ' ' << is_growing;
    }
}

// Jha & Lipton 2018, doi:10.1137/17M1112236, (65): it exceeds 1 only while √λ Δt < 2
TEST(SpectralRadius, of_implicit_euler_is_that_of_the_paper)
{
  const Scheme &euler = scheme("implicit Euler");
  for (const double z : {.1, .5, 1.5, 1.99, 2.01, 5.})
  {
    EXPECT_NEAR(spectral_radius(euler, z * z, 1), std::abs(1 + z) / std::abs(1 - z * z), 1e-12);
    EXPECT_EQ(spectral_radius(euler, z * z, 1) > 1, z < 2) << z;
  }
  EXPECT_NEAR(spectral_radius(scheme("explicit Euler"), .04, 1), 1.2, 1e-12);
  EXPECT_NEAR(spectral_radius(scheme("theta 0.3"), -4, 1), std::sqrt((1 + .49 * 4) / (1 + .09 * 4)),
              1e-12);
}

TEST(Integrate, runge_kutta_is_exact_in_time)
{
  const Motion damped{1, oscillator(3).acceleration, {}, .4};
  State state{{1}, {0}, 0};
  double last = 0;
  integrate(damped, scheme("Runge-Kutta"), {.5, {}, false, 1e-13}, 4, state,
            [&](const State &now) { last = now.t; });
  const double omega = std::sqrt(9 - .04);
  EXPECT_NEAR(state.u[0], std::exp(-.8) * (std::cos(4 * omega) + .2 / omega * std::sin(4 * omega)),
              1e-11);
  EXPECT_DOUBLE_EQ(last, 4);
}

TEST(Integrate, runge_kutta_is_as_exact_for_small_motions)
{
  constexpr double small = 1e-3;
  State state{{small}, {0}, 0};
  integrate(oscillator(3), scheme("Runge-Kutta"), {.5, {}, false, 1e-13}, 4, state);
  EXPECT_NEAR(state.u[0], small * std::cos(12), 1e-10 * small);
}

TEST(Integrate, schemes_are_bounded_up_to_their_limits)
{
  EXPECT_NEAR(stability_limit(scheme("symplectic Euler")), 2, 1e-6);
  EXPECT_NEAR(stability_limit(scheme("velocity Verlet")), 2, 1e-6);
  EXPECT_EQ(stability_limit(scheme("explicit Euler")), 0);
  EXPECT_EQ(stability_limit(scheme("trapezoidal")), std::numeric_limits<double>::infinity());
  // beyond its limit Blanes-Moan has a narrow band of slow growth, up to 3.16
  EXPECT_NEAR(stability_limit(scheme("Blanes-Moan")), 3.13, .01);
  for (const auto &[name, beyond] :
       {std::pair{"symplectic Euler", 2.0005}, std::pair{"velocity Verlet", 2.0005},
        std::pair{"Blanes-Moan", 3.145}})
    for (const bool is_stable : {true, false})
    {
      const double step = is_stable ? .99 * stability_limit(scheme(name)) : beyond;
      State state{{1}, {.1}, 0};
      integrate(oscillator(1), scheme(name), {step, {}, true}, 2000 * step, state);
      EXPECT_EQ(norm(state.u) + norm(state.v) < 100, is_stable) << name;
    }
}

TEST(Integrate, a_step_ends_on_time)
{
  State state{{1}, {0}, 0};
  int n = 0;
  const auto counts = integrate(oscillator(1), scheme("velocity Verlet"), {.3}, 1, state,
                                [&](const State &now) { EXPECT_NEAR(now.t, .25 * ++n, 1e-15); });
  EXPECT_EQ(n, 4);
  EXPECT_EQ(counts.n_steps, 4u);
  EXPECT_EQ(counts.n_accelerations, 5u); // one a step and one to begin with
  EXPECT_EQ(state.t, 1);
}

TEST(Integrate, refuses_what_it_cannot_follow)
{
  const Motion motion = oscillator(2);
  const State state{{1}, {0}, 0};
  EXPECT_NE(refusal(motion, "velocity Verlet", {0}, state).find("time step = 0 must be positive"),
            std::string::npos);
  EXPECT_NE(refusal(motion, "velocity Verlet", {NAN}, state).find("time step"), std::string::npos);
  EXPECT_NE(refusal(motion, "velocity Verlet", {1.1, 1.}, state).find("critical step 1 "),
            std::string::npos);
  EXPECT_EQ(refusal(motion, "velocity Verlet", {1.1, 1., true}, state), "accepted");
  EXPECT_EQ(refusal(motion, "trapezoidal", {1.1, 1.}, state), "accepted");
  EXPECT_NE(refusal(motion, "velocity Verlet", {.1}, {{NAN}, {0}, 0}).find("not finite"),
            std::string::npos);
  EXPECT_NE(refusal(motion, "velocity Verlet", {.1}, {{0, 0}, {0}, 0}).find("1 unknowns"),
            std::string::npos);
  EXPECT_NE(refusal(motion, "velocity Verlet", {.1}, state, -1).find("before the initial"),
            std::string::npos);
  EXPECT_NE(refusal({1, motion.acceleration, motion.tangent, -1}, "velocity Verlet", {.1}, state)
                .find("damping = -1"),
            std::string::npos);
  EXPECT_NE(refusal({1, motion.acceleration}, "trapezoidal", {.1}, state).find("tangent"),
            std::string::npos);
  EXPECT_THROW(scheme("leapfrog"), InputError);
}

TEST(Integrate, says_when_numbers_leave_the_finite)
{
  State state{{1}, {0}, 0};
  EXPECT_THROW(integrate(oscillator(1), scheme("velocity Verlet"), {100., 2., true}, 1e5, state),
               NumericalError);
  // growth faster than an implicit step can follow: I - Δt²θ² a' < 0
  const Motion unstable{1, [](const Vector &u, double, Vector &a) { a[0] = 9 * u[0]; },
                        [](const Vector &, const Vector &v, Vector &out) { out[0] = 9 * v[0]; }};
  state = {{1}, {0}, 0};
  EXPECT_THROW(integrate(unstable, scheme("implicit Euler"), {.4}, .8, state), NumericalError);
  state = {{1}, {0}, 0};
  EXPECT_NO_THROW(integrate(unstable, scheme("implicit Euler"), {.3}, .9, state));
}

TEST(CriticalStep, largest_eigenvalue_of_a_chain_is_its_closed_form)
{
  const std::size_t n = 300;
  const auto chain = [](const Vector &x, Vector &y)
  {
    for (std::size_t i = 0; i < x.size(); ++i)
      y[i] = 2 * x[i] - (i > 0 ? x[i - 1] : 0) - (i + 1 < x.size() ? x[i + 1] : 0);
  };
  EXPECT_NEAR(largest_eigenvalue(chain, n, 1e-8), 2 + 2 * std::cos(M_PI / (n + 1.)), 1e-8);
  const Motion motion{n,
                      {},
                      [&](const Vector &, const Vector &v, Vector &out)
                      {
                        chain(v, out);
                        for (double &value : out)
                          value = -value;
                      }};
  EXPECT_NEAR(critical_step(motion, scheme("velocity Verlet"), Vector(n), 1e-8), 1, 1e-4);
}
