// Double wells beside what Jha & Lipton 2018, doi:10.1137/17M1112236, prove of them: errors over
// time and energies below their bounds, and the local limit.

#include "analysis/critical_step.h"
#include "base/error.h"
#include "meshfree/lattice/double_well_force.h"
#include "meshfree/method.h"
#include "meshfree/rules/rules.h"
#include "physics/one_step_bound.h"
#include "reference/method.h"
#include "study/local_waves.h"
#include "study/torus_reference.h"
#include "study/transient.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::study;
using analysis::State;
using analysis::Vector;

namespace
{
  using Settings = std::vector<scene::Override>;

  scene::Scene torus(const Settings &settings)
  {
    Settings all = {{"Study/h", "0.1, 0.05, 0.025"}};
    all.insert(all.end(), settings.begin(), settings.end());
    return scene::parse_scene("t.prm", scene::scene_template("double-well"), all);
  }

  StudyResults run(const scene::Scene &scene)
  {
    Methods available = meshfree::methods();
    for (const auto &method : reference::methods())
      available.push_back(method);
    const Analysis analysis = transient_analysis(available);
    const Methods methods = analysis.choose_methods(scene, available, 0, 1);
    analysis.check(scene, methods, 0);
    StudyResults results = run_study(analysis, scene, methods);
    for (const Record &record : results.records)
      EXPECT_EQ(record.failure, "") << record.key.label();
    return results;
  }

  std::string refusal(const Settings &settings)
  {
    try
    {
      (void)torus(settings);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "accepted";
  }

  /// On a line with J = r, for which C_bar = 2 is finite.
  Settings line(const Settings &settings)
  {
    Settings all = {
        {"Domain/dimension", "1"},       {"Kernel/type", "polynomial"},
        {"Kernel/coefficients", "0, 1"}, {"Methods/names", "FA"},
        {"Time/final time", "0.02"},     {"Time/initial displacement", "0.001*sin(2*pi*x)"},
        {"Time/a priori bounds", "true"}};
    all.insert(all.end(), settings.begin(), settings.end());
    return all;
  }
} // namespace

// u = a sin kx cos ωt: its norms are known, and a small amplitude makes bonds linear
TEST(DoubleWellBounds, constants_are_those_of_a_wave)
{
  const auto results = run(torus(line({{"Time/schemes", "symplectic Euler, theta 0.5"},
                                       {"Time/steps", "0.0005"},
                                       {"Methods/names", "IPA-AC-R2"}, // exact second moment
                                       {"Study/h", "0.025"}})));
  ASSERT_EQ(results.records.size(), 2u);
  const double k = 2 * M_PI, a = 1e-3, horizon = .2;
  // ω² = 4p/ε² ∫ J (1 - cos kεr)/r dr = 4/ε² (1 - sinc kε)
  const double square = 4 / (horizon * horizon) * (1 - std::sin(k * horizon) / (k * horizon)),
               omega = std::sqrt(square), l2 = a * std::sqrt(.5), holder = a * (1 + k);
  // u_ttt is largest where sin ωt is, after a time ωT
  const double third = square * omega * l2 * std::sin(omega * .02);
  for (const Record &record : results.records)
  {
    EXPECT_NEAR(record["C_t"], .5 * (square * l2 + third), .03 * record["C_t"]);
    EXPECT_NEAR(record["C_s"], horizon * horizon * square * holder + 8 * holder,
                .02 * record["C_s"]);
  }
  const Record &half = results.records[1];
  EXPECT_NEAR(half["C_t of (49)"], (third + square * square * l2) / 12, .06 * half["C_t of (49)"]);
}

// of a wave of five periods, and of one that is seen shortly before its end
TEST(DoubleWellBounds, the_reference_is_known_at_all_times)
{
  const auto solve = [](double final_time)
  {
    const scene::Scene scene =
        torus(line({{"Time/final time", std::to_string(final_time)}, {"Study/h", "0.025"}}));
    ProblemsInTime<2>::Loads loads;
    ProblemsInTime<2> problems(scene, 0, scene.study.series[0].levels[0], loads);
    return solve_torus(scene, reference::methods(), .2, problems);
  };
  EXPECT_THROW((void)solve(40), InputError); // some 30 periods
  constexpr double final_time = 6.4;
  const TorusSolution whole = solve(final_time);
  const std::vector<dealii::Point<2>> nodes = {{.2, 0.}, {.26, 0.}, {.7, 0.}};
  for (const double part : {.5 / 32, 10.5 / 32, 31.5 / 32})
  {
    const TorusSolution until = solve(part * final_time);
    const auto u = whole.torus.at(nodes, whole.at(part * final_time).u),
               exact = until.torus.at(nodes, until.torus.state.u);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      EXPECT_NEAR(u[k], exact[k], 1e-8 * 1e-3) << part;
  }
}

TEST(DoubleWellBounds, hold_for_errors_and_energies_over_time)
{
  for (const char *const speed : {"0", "cos(2*pi*x)"})
  {
    const auto results = run(torus(line({{"Time/schemes", "symplectic Euler, theta 0.5, theta 0.8"},
                                         {"Time/steps", "0.001, 0.0005"},
                                         {"Time/initial displacement", "0.3*sin(2*pi*x)"},
                                         {"Time/initial velocity", speed}})));
    ASSERT_EQ(results.records.size(), 18u);
    for (const Record &record : results.records)
    {
      EXPECT_GT(record["largest error over time"], 0);
      EXPECT_LT(record["largest error over time"], record["error bound"]);
      EXPECT_LE(record["largest energy"], record["energy bound"]);
      EXPECT_EQ(record.text("error bound of"),
                record.text("scheme") == "symplectic Euler" ? "(17)" : "(52)");
      // no sooner than at the end
      EXPECT_GE(record["largest error over time"] * (1 + 1e-6),
                record["nodal L2 | reference"] + record["velocity nodal L2 | reference"]);
    }
    EXPECT_TRUE(results.warnings.empty());
  }
}

// The same bonds at all points of space: errors of time alone. With the constant of θ = ½ in the
// bound, (49), a scheme of first order breaks it.
TEST(DoubleWellBounds, of_second_order_fail_for_a_scheme_of_first_order)
{
  const physics::DoubleWell law(1, std::vector<physics::PowerTerm>{{1, 0}, {-1, 1}}, 1, 1, .2);
  const int n = 40;
  const meshfree::DoubleWellForce<1> force(meshfree::axis_bonds(law, 1. / n, "FA"), 1. / n, {n, 1},
                                           meshfree::Exterior::periodic);
  const analysis::Motion motion{
      force.size(), [&](const Vector &u, double, Vector &a) { force.force(u, a); },
      [&](const Vector &u, const Vector &v, Vector &out) { force.tangent(u, v, out); }};
  State start{Vector(n), Vector(n), 0};
  for (int i = 0; i < n; ++i)
    start.u[i] = .3 * std::sin(2 * M_PI * i / n);
  const double limit = analysis::critical_step(motion, analysis::scheme("velocity Verlet"),
                                               Vector(motion.n)),
               lipschitz = 4 / (limit * limit), end = 1 / lipschitz;
  const double weight = 1 / std::sqrt(static_cast<double>(n)); // L² of a line of length 1
  const auto l2 = [&](const Vector &x) { return weight * analysis::norm(x); };
  // u_tttt by differences of forces; it and u_ttt change little in so short a time
  physics::SolutionNorms norms;
  State now = start;
  Vector a(n), before(n), after(n);
  constexpr double shift = 1e-3;
  const auto observe = [&](const State &state)
  {
    force.force(state.u, a);
    const auto at = [&](double t, Vector &result)
    {
      Vector u = state.u;
      for (int i = 0; i < n; ++i)
        u[i] += t * (state.v[i] + .5 * t * a[i]);
      force.force(u, result);
    };
    at(-shift, before);
    at(shift, after);
    Vector third(n), fourth(n);
    for (int i = 0; i < n; ++i)
    {
      third[i] = (after[i] - before[i]) / (2 * shift);
      fourth[i] = (after[i] - 2 * a[i] + before[i]) / (shift * shift);
    }
    norms.second = std::max(norms.second, l2(a));
    norms.third = std::max(norms.third, l2(third));
    norms.fourth = std::max(norms.fourth, l2(fourth));
  };
  observe(now);
  analysis::integrate(motion, analysis::scheme("Runge-Kutta"), {end / 20}, end, now, observe);
  const auto ratio = [&](const std::string &name, double theta, int n_steps)
  {
    const double step = end / n_steps;
    std::vector<State> exact;
    State state = start;
    analysis::integrate(motion, analysis::scheme("Runge-Kutta"), {step}, end, state,
                        [&](const State &s) { exact.push_back(s); });
    double error = 0;
    std::size_t k = 0;
    state = start;
    analysis::integrate(motion, analysis::scheme(name), {step}, end, state,
                        [&](const State &s)
                        {
                          State off = s;
                          analysis::add(off.u, -1, exact[k].u);
                          analysis::add(off.v, -1, exact[k].v);
                          ++k;
                          error = std::max(error, l2(off.u) + l2(off.v));
                        });
    const double truncation =
        theta == .5 ? physics::c_t_of_trapezoidal(norms) * step * step : physics::c_t(norms) * step;
    return error / physics::one_step_bound(lipschitz, theta, step,
                                           static_cast<std::uint64_t>(n_steps), truncation);
  };
  for (const int n_steps : {4, 16, 64, 256})
  {
    EXPECT_LT(ratio("theta 0.5", .5, n_steps), 1) << n_steps;
    EXPECT_LT(ratio("theta 0.7", .7, n_steps), 1) << n_steps;
    EXPECT_LT(ratio("theta 1", 1, n_steps), 1) << n_steps;
  }
  EXPECT_GT(ratio("theta 0.5", .5, 64), .02); // of its size
  EXPECT_GT(ratio("theta 0.7", .5, 256), 1);  // the bound of θ = ½
}

TEST(DoubleWellBounds, say_which_steps_they_do_not_cover)
{
  const auto results = run(torus(line({{"Time/schemes", "theta 0.5"},
                                       {"Time/steps", "0.025, 0.01, 0.001"},
                                       {"Time/final time", "0.1"},
                                       {"Time/a priori bounds", "false"},
                                       {"Study/h", "0.1"}})));
  // ε²/C̄ = .02, and 1/(θ 6 C̄/ε²) = .00667
  ASSERT_EQ(results.warnings.size(), 2u);
  EXPECT_NE(results.warnings[0].find("0.025 are not below ε²/C̄ = 0.02"), std::string::npos)
      << results.warnings[0];
  EXPECT_NE(results.warnings[1].find("0.01 are below ε²/C̄ = 0.02, (53)"), std::string::npos)
      << results.warnings[1];
  EXPECT_NE(results.warnings[1].find("not below 0.006667"), std::string::npos)
      << results.warnings[1];
  EXPECT_FALSE(results.records[0].has("error bound"));
}

TEST(DoubleWellBounds, are_refused_where_they_do_not_hold)
{
  EXPECT_NE(refusal({{"Time/a priori bounds", "true"}, {"Time/density", "2"}})
                .find("Time/a priori bounds = true needs Time/density = 1"),
            std::string::npos);
  EXPECT_NE(refusal({{"Time/Hoelder exponent", "1.5"}}).find("must be in (0, 1]"),
            std::string::npos);
}

// Section 5: with its wells' modulus, the linear waves, here each of one speed
TEST(LocalWaves, move_each_part_with_its_speed)
{
  const scene::Scene scene = torus({{"Material/c", "3"}, {"Time/density", "2"}});
  const auto speeds = make_double_well(scene, .1).wave_speeds(2);
  constexpr double k = 2 * M_PI, t = .37;
  const LocalWaves waves(
      scene,
      [](const dealii::Point<2> &x, unsigned int c)
      { return c == 0 ? std::sin(k * x[0]) + .25 : 2 * std::cos(k * x[0]); },
      [](const dealii::Point<2> &x, unsigned int c)
      { return c == 1 ? std::cos(k * x[0]) + .5 : 0; });
  const dealii::Point<2> x(.3, .8);
  const auto state = waves.at(t, {x});
  const double l = speeds.longitudinal * k, s = speeds.transverse * k;
  EXPECT_NEAR(state.u[0], std::sin(k * .3) * std::cos(l * t) + .25, 1e-12);
  EXPECT_NEAR(state.u[1], std::cos(k * .3) * (2 * std::cos(s * t) + std::sin(s * t) / s) + .5 * t,
              1e-12);
  EXPECT_NEAR(state.v[0], -l * std::sin(k * .3) * std::sin(l * t), 1e-11);
  EXPECT_NEAR(state.v[1], std::cos(k * .3) * (-2 * s * std::sin(s * t) + std::cos(s * t)) + .5,
              1e-11);
  EXPECT_THROW(
      LocalWaves(scene, [](const dealii::Point<2> &y, unsigned int) { return std::abs(y[0] - .5); },
                 {}),
      InputError);
}

TEST(LocalWaves, along_a_diagonal_solve_their_equation)
{
  // u_tt by differences against μ/ρ (Δu + 2 ∇ div u)
  const scene::Scene scene = torus({});
  const double modulus = make_double_well(scene, .1).modulus();
  constexpr double k = 2 * M_PI;
  const LocalWaves waves(scene,
                         [](const dealii::Point<2> &x, unsigned int c) {
                           return c == 0 ? std::sin(k * (x[0] + 2 * x[1]))
                                         : std::cos(k * (x[0] - x[1]));
                         },
                         {});
  constexpr double d = 1e-3, t = .2;
  const auto u = [&](double dt, double dx, double dy, unsigned int c)
  { return waves.at(t + dt, {dealii::Point<2>(.21 + dx, .34 + dy)}).u[c]; };
  for (unsigned int c = 0; c < 2; ++c)
  {
    const double tt = (u(d, 0, 0, c) - 2 * u(0, 0, 0, c) + u(-d, 0, 0, c)) / (d * d),
                 xx = (u(0, d, 0, c) - 2 * u(0, 0, 0, c) + u(0, -d, 0, c)) / (d * d),
                 yy = (u(0, 0, d, c) - 2 * u(0, 0, 0, c) + u(0, 0, -d, c)) / (d * d),
                 other = (u(0, d, d, 1 - c) - u(0, d, -d, 1 - c) - u(0, -d, d, 1 - c) +
                          u(0, -d, -d, 1 - c)) /
                         (4 * d * d);
    EXPECT_NEAR(tt, modulus * (xx + yy + 2 * (c == 0 ? xx : yy) + 2 * other), 2e-3 * std::abs(tt));
  }
}

// Small amplitudes: order 2 in the horizon, of dispersion and the lattice. Large ones: order 1,
// because bonds soften by a part β r S² of themselves.
TEST(LocalWaves, are_the_limit_of_double_wells)
{
  const auto rate = [](const std::string &displacement)
  {
    const auto results = run(torus({{"Domain/dimension", "1"},
                                    {"Methods/names", "IPA-AC-R2"},
                                    {"Time/initial displacement", displacement},
                                    {"Time/schemes", "Blanes-Moan"},
                                    {"Time/steps", ""},
                                    {"Problem/local solution", "computed"},
                                    {"Reference/method", "none"},
                                    {"Study/regime", "delta"},
                                    {"Study/m", "4"},
                                    {"Study/h", "0.00625, 0.003125, 0.0015625"},
                                    {"Study/decisive error", "nodal L2 | local"}}));
    const auto &errors = results.trends.front().values;
    EXPECT_EQ(errors.size(), 3u);
    return std::log2(errors[1] / errors[2]);
  };
  EXPECT_NEAR(rate("1e-4*sin(2*pi*x)"), 2, .05);
  EXPECT_NEAR(rate("0.2*sin(2*pi*x)"), 1, .15);
}

// A linear wave u_tt = Δu whose u is given: only rules with exact second moments arrive at it.
TEST(LocalWaves, of_linear_models_are_given_as_expressions)
{
  const std::string u = "sin(2*pi*(x + y))";
  const auto results =
      run(scene::parse_scene("t.prm", scene::scene_template("scalar"),
                             {{"Problem/solution", ""},
                              {"Problem/load", "0"},
                              {"Problem/constraint", u + "*cos(2*pi*sqrt(2)*t)"},
                              {"Problem/local solution", u + "*cos(2*pi*sqrt(2)*t)"},
                              {"Kernel/limit", "-Laplace"},
                              {"Time/final time", "0.3"},
                              {"Time/initial displacement", u},
                              {"Methods/names", "FA, IPA-AC-R2"},
                              {"Study/regime", "delta"},
                              {"Study/m", "3"},
                              {"Study/h", "0.1, 0.05, 0.025, 0.0125"},
                              {"Study/norms", "nodal L2"},
                              {"Study/decisive error", "nodal L2 | local"}}));
  ASSERT_EQ(results.trends.size(), 4u); // u and its rate, by two methods
  for (const Trend &trend : results.trends)
  {
    const double rate = std::log2(trend.values[2] / trend.values[3]);
    const bool is_right = trend.method == "IPA-AC-R2";
    EXPECT_NEAR(rate, is_right ? 2 : .1, is_right ? .2 : .4) << trend.method << ", " << trend.error;
  }
}

TEST(BoundaryFunction, has_no_manufactured_load)
{
  for (const std::string omega : {"0.5", "smoothstep"})
  {
    const std::string told = refusal({{"Domain/boundary", "constrained"},
                                      {"Problem/solution", "0.1*sin(2*pi*x)*cos(t), 0"},
                                      {"Time/initial displacement", ""},
                                      {"Material/boundary function", omega}});
    EXPECT_NE(told.find("manufactured loads are those of Material/boundary function = one"),
              std::string::npos)
        << told;
  }
}

TEST(LocalWaves, are_refused_where_they_are_not_known)
{
  EXPECT_NE(refusal({{"Problem/local solution", "computed"}, {"Time/damping", "1"}})
                .find("needs Time/damping = 0"),
            std::string::npos);
  EXPECT_NE(refusal({{"Study/decisive error", "nodal L2 | local"}})
                .find("give Problem/local solution as an expression"),
            std::string::npos);
}

TEST(BoundaryFunction, of_an_expression_weakens_bonds)
{
  const auto with = [](const std::string &omega)
  {
    return run(torus({{"Domain/boundary", "constrained"},
                      {"Material/boundary function", omega},
                      {"Problem/load", "0, 0"},
                      {"Problem/constraint", "0, 0"},
                      {"Time/initial displacement", "0.01*sin(2*pi*x)*sin(2*pi*y), 0"},
                      {"Reference/method", "none"},
                      {"Methods/names", "FA"},
                      {"Study/h", "0.1"},
                      {"Study/decisive error", "nodal L2 | exact"},
                      {"Problem/solution", "0.01*sin(2*pi*x)*sin(2*pi*y), 0"},
                      {"Time/final time", "0.05"}}))
        .records.front()["kinetic energy"];
  };
  // ω as a constant .5 weakens each bond by .25: a quarter of the accelerations, at first
  EXPECT_NEAR(with("0.5") / with("one"), .25 * .25, .01);
  const std::string box = "max(0, min(1, min(min(x, 1 - x), min(y, 1 - y))/delta))",
                    smoothstep = "(" + box + ")^2*(3 - 2*" + box + ")";
  EXPECT_NEAR(with(smoothstep), with("smoothstep"), 1e-9 * with("smoothstep"));
  EXPECT_NE(refusal({{"Domain/boundary", "constrained"},
                     {"Problem/solution", "0, 0"},
                     {"Problem/load", "0, 0"},
                     {"Reference/method", "none"},
                     {"Study/decisive error", "nodal L2 | exact"},
                     {"Material/boundary function", "1 + x"}})
                .find("omega must be in [0, 1]"),
            std::string::npos);
}
