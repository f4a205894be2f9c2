// Scenes that move, run by both sides: rates in time and space, energies, and what is refused.

#include "study/transient.h"

#include "base/error.h"
#include "meshfree/method.h"
#include "reference/method.h"
#include "study/preflight.h"
#include "study/sample_sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

using namespace plumbline;
using namespace plumbline::study;

namespace
{
  using Settings = std::vector<scene::Override>;

  scene::Scene scene_of(const std::string &model, const Settings &common, const Settings &settings)
  {
    Settings all = common;
    all.insert(all.end(), settings.begin(), settings.end());
    return scene::parse_scene("t.prm", scene::scene_template(model), all);
  }

  /// A manufactured motion, h at a fixed horizon.
  scene::Scene wave(const std::string &model, const std::string &solution, const Settings &settings)
  {
    return scene_of(model,
                    {{"Problem/solution", solution},
                     {"Time/final time", "0.5"},
                     {"Study/regime", "delta"},
                     {"Study/h", "0.2, 0.1, 0.05"},
                     {"Study/norms", "nodal L2"},
                     {"Study/decisive error", "nodal L2 | exact"}},
                    settings);
  }

  scene::Scene torus(const Settings &settings)
  {
    return scene_of("double-well", {{"Study/h", "0.1, 0.05, 0.025"}}, settings);
  }

  Methods available()
  {
    Methods all = meshfree::methods();
    for (const auto &method : reference::methods())
      all.push_back(method);
    return all;
  }

  StudyResults run(const scene::Scene &scene)
  {
    const Analysis analysis = transient_analysis(available());
    const Methods methods = analysis.choose_methods(scene, available(), 0, 1);
    analysis.check(scene, methods, 0);
    const StudyResults results = run_study(analysis, scene, methods);
    for (const Record &record : results.records)
      EXPECT_EQ(record.failure, "") << record.key.label();
    return results;
  }

  std::vector<Trend> over_levels(const StudyResults &results)
  {
    std::vector<Trend> trends;
    for (const Trend &trend : results.trends)
      if (trend.axis != Axis::time_step)
        trends.push_back(trend);
    return trends;
  }

  std::vector<Trend> over_steps(const StudyResults &results)
  {
    std::vector<Trend> trends;
    for (const Trend &trend : results.trends)
      if (trend.axis == Axis::time_step)
        trends.push_back(trend);
    return trends;
  }

  std::string proven(const StudyResults &results)
  {
    return results.facts.at("proven order of rules");
  }

  /// Errors of u at the levels, coarse to fine.
  std::vector<double> errors(const StudyResults &results, const std::string &method,
                             const std::string &prefix = "")
  {
    for (const Trend &trend : results.trends)
      if (trend.method == method && trend.error == prefix + results.decisive_error)
        return trend.values;
    throw InputError("no such trend: " + method);
  }

  double last_rate(const std::vector<double> &errors)
  {
    return std::log2(errors[errors.size() - 2] / errors.back());
  }
} // namespace

TEST(Motions, manufactured_fields_that_methods_hold_are_exact_to_round_off)
{
  // bilinear in space with constants and first moments right: errors are those of time alone
  const Settings settings = {{"Methods/names", "PA-AC, IPA-AC-R2, Q1, Q2, DGQ1"},
                             {"Study/h", "0.2"},
                             {"Study/m", "2.5"},
                             {"Time/density", "1.7"},
                             {"Time/damping", "0.6"},
                             {"Time/schemes", "Runge-Kutta"}};
  for (const bool is_lumped : {false, true})
  {
    Settings with_mass = settings;
    with_mass.push_back({"Time/mass", is_lumped ? "lumped" : "consistent"});
    const auto results = run(wave("scalar", "(1 + x)*(2 - y)*sin(2*t) + x - y", with_mass));
    ASSERT_EQ(results.records.size(), 5u);
    for (const Record &motion : results.records)
      if (!is_lumped || motion.key.family == MethodFamily::meshfree)
      {
        EXPECT_LT(motion["nodal L2 | exact"], 1e-9) << motion.key.method;
        EXPECT_LT(motion["velocity nodal L2 | exact"], 1e-8) << motion.key.method;
      }
  }
}

TEST(Motions, converge_in_space_at_the_order_of_their_method)
{
  const std::string solution = "sin(2*x + y - 3*t)";
  const auto results = run(
      wave("scalar", solution,
           {{"Methods/names", "FA, IPA-AC-R2, IPA-AC-R4, Q1"}, {"Time/schemes", "Runge-Kutta"}}));
  EXPECT_NEAR(last_rate(errors(results, "IPA-AC-R2")), 2, .2);
  EXPECT_NEAR(last_rate(errors(results, "IPA-AC-R4")), 4, .4);
  EXPECT_NEAR(last_rate(errors(results, "Q1")), 2, .2);
  EXPECT_LT(last_rate(errors(results, "FA")), .5); // wrong second moments
  EXPECT_NEAR(last_rate(errors(results, "Q1", "velocity ")), 2, .3);
}

// x y is harmonic at all times: no second moment is seen.
TEST(Motions, that_hide_wrong_moments_are_right_for_this_field_only)
{
  const auto results = run(wave("scalar", "x*y*cos(2*t) + x",
                                {{"Methods/names", "FA, IPA-AC-R2, Q1"},
                                 {"Study/h", "0.25, 0.2, 0.125, 0.1"},
                                 {"Time/schemes", "Runge-Kutta"}}));
  for (const Trend &trend : over_levels(results))
    EXPECT_EQ(trend.verdict, trend.method == "FA" ? "AC for this field only" : "AC")
        << trend.method << ": " << trend.reason;
}

TEST(Motions, of_solids_agree_on_both_sides)
{
  const auto results = run(
      wave("LPS", "sin(t)*x^2*y + y^2, cos(2*t)*x*y^2 + x^2",
           {{"Methods/names", "IPA-AC-R2, Q1"}, {"Time/density", "2"}, {"Time/damping", "0.5"}}));
  EXPECT_GT(last_rate(errors(results, "IPA-AC-R2")), 1.7);
  EXPECT_GT(last_rate(errors(results, "Q1")), 1.7);
  for (const Record &motion : results.records)
    EXPECT_LT(motion["energy imbalance"], .02)
        << motion.key.method; // trapezoidal work over the steps
}

TEST(Motions, schemes_show_their_orders_in_time)
{
  const std::vector<std::pair<std::string, double>> expected = {
      {"explicit Euler", 1}, {"symplectic Euler", 1}, {"velocity Verlet", 2},
      {"Blanes-Moan", 4},    {"trapezoidal", 2},      {"implicit Euler", 1}};
  std::string names;
  for (const auto &[name, order] : expected)
    names += (names.empty() ? "" : ", ") + name;
  const auto results = run(torus({{"Methods/names", "PA-AC"},
                                  {"Study/h", "0.1"},
                                  {"Reference/method", "none"},
                                  {"Study/decisive error", "nodal L2 | exact"},
                                  {"Time/initial displacement", "0.2*sin(2*pi*x), 0.1*cos(2*pi*y)"},
                                  {"Time/schemes", names},
                                  {"Time/show blow-up", "true"},
                                  {"Time/steps", "0.025, 0.0125, 0.00625, 0.003125"}}));
  const std::vector<Trend> orders = over_steps(results);
  ASSERT_EQ(orders.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    EXPECT_EQ(orders[i].variant, expected[i].first);
    EXPECT_NEAR(orders[i].rate, expected[i].second, .15) << expected[i].first;
  }
}

// Newton's method on the tangent of the nonlinear forces: with it steps are implicit.
TEST(Motions, of_double_wells_by_galerkin_show_the_orders_of_implicit_schemes)
{
  // horizons of two cells and of one, which is cheap
  for (const auto &[mass, h] : {std::pair{"consistent", "0.125"}, {"lumped", "0.2"}})
  {
    const auto results =
        run(torus({{"Methods/names", "Q1"},
                   {"Study/h", h},
                   {"Reference/method", "none"},
                   {"Study/decisive error", "nodal L2 | exact"},
                   {"Time/initial displacement", "0.2*sin(2*pi*x), 0.1*cos(2*pi*y)"},
                   {"Time/final time", "0.1"},
                   {"Time/mass", mass},
                   {"Time/schemes", "trapezoidal, implicit Euler"},
                   {"Time/steps", "0.05, 0.025"}}));
    const std::vector<Trend> orders = over_steps(results);
    ASSERT_EQ(orders.size(), 2u);
    EXPECT_NEAR(orders[0].rate, 2, .15) << mass;
    EXPECT_NEAR(orders[1].rate, 1, .15) << mass;
  }
}

TEST(Motions, of_double_wells_tend_to_the_torus_without_a_mesh)
{
  const auto results = run(torus({{"Time/initial displacement", "0.2*sin(2*pi*x), 0"},
                                  {"Time/schemes", "Blanes-Moan"},
                                  {"Methods/names", "FA, IPA-AC-R2"}}));
  for (const Record &record : results.records) // it is the same for all
    EXPECT_EQ(record["reference change"], results.records[0]["reference change"]);
  EXPECT_LT(results.records[0]["reference change"], 1e-8);
  const auto of_rule = errors(results, "IPA-AC-R2");
  EXPECT_NEAR(last_rate(of_rule), 2, .3);
  EXPECT_LT(of_rule.back(), .5 * errors(results, "FA").back());
  for (const Record &motion : results.records)
    EXPECT_LT(motion["energy imbalance"], 1e-3) << motion.key.method; // symplectic
}

TEST(Motions, on_a_line_show_each_rule_at_its_own_rate)
{
  const auto on_line = [](const std::string &methods, const std::string &h)
  {
    return run(torus({{"Domain/dimension", "1"},
                      {"Time/initial displacement", "0.3*sin(2*pi*x)"},
                      {"Time/final time", "0.5"},
                      {"Time/schemes", "Blanes-Moan"},
                      {"Time/steps", "0.01"},
                      {"Study/horizon", "0.1"},
                      {"Study/h", h},
                      {"Methods/names", methods}}));
  };
  // of u plus u', by an independent program
  const auto rules = on_line("FA, IPA-AC, IPA-AC-R2", "0.05, 0.025, 0.0125, 0.00625, 0.003125");
  const std::map<std::string, std::array<double, 2>> expected = {
      {"FA", {1.43e-1, 4.46e-4}}, {"IPA-AC", {4.36e-2, 1.58e-4}}, {"IPA-AC-R2", {1.39e-3, 5.6e-6}}};
  for (const auto &[method, first_and_last] : expected)
  {
    const auto u = errors(rules, method), v = errors(rules, method, "velocity ");
    EXPECT_NEAR((u.at(0) + v.at(0)) / first_and_last[0], 1, .005) << method;
    EXPECT_NEAR((u.at(4) + v.at(4)) / first_and_last[1], 1, .005) << method;
  }
  EXPECT_LT(rules.records.at(0)["reference change"] + rules.records[0]["energy imbalance"], 1e-8);
  const auto galerkin = on_line("Q1, Q2", "0.0125, 0.00625");
  EXPECT_NEAR(last_rate(errors(galerkin, "Q1")), 2, .2);
  EXPECT_GT(last_rate(errors(galerkin, "Q2")), 2.7);
  EXPECT_EQ(proven(rules), "γ <= 1");
}

TEST(Motions, on_the_torus_without_a_mesh_are_known_to_eight_digits)
{
  for (const auto &[amplitude, time] : {std::pair{.4, "0.5"}, {.6, "0.3"}, {.5, "0.4"}})
  {
    const auto results =
        run(torus({{"Domain/dimension", "1"},
                   {"Time/initial displacement", std::to_string(amplitude) + "*sin(2*pi*x)"},
                   {"Time/final time", time},
                   {"Study/h", "0.05"},
                   {"Study/horizon", "0.1"},
                   {"Methods/names", "FA"}}));
    EXPECT_LT(results.records.at(0)["reference change"], 1e-8 * 2 * amplitude) << amplitude;
    EXPECT_LT(results.records[0]["reference points"], 162); // the last one is not it by chance
  }
}

TEST(Motions, of_galerkin_know_their_own_errors)
{
  const auto results = run(torus({{"Methods/names", "Q1, FA"},
                                  {"Study/h", "0.2"},
                                  {"Reference/estimate", "every"},
                                  {"Time/final time", "0.05"},
                                  {"Time/steps", "0.025"}}));
  for (const Record &motion : results.records)
  {
    ASSERT_EQ(motion.has("estimated error"), motion.key.family == MethodFamily::reference)
        << motion.key.method;
    if (!motion.has("estimated error"))
      continue;
    const double error = motion["nodal L2 | reference"];
    EXPECT_GT(motion["estimated error"], error) << motion.key.method << ' ' << motion.key.h;
    EXPECT_LT(motion["estimated error"], 5 * error) << motion.key.method << ' ' << motion.key.h;
    EXPECT_LT(motion["estimated error by quadrature"], .1 * motion["estimated error in space"])
        << motion.key.method;
    EXPECT_GT(motion["estimated error by quadrature"], 0) << motion.key.method;
  }
  // linear motions, whose forces are exact
  const Settings settings = {{"Methods/names", "Q1, Q2, Q3, DGQ1"},
                             {"Study/h", "0.1"},
                             {"Study/m", "2"},
                             {"Time/final time", "0.2"},
                             {"Time/steps", "0.01"},
                             {"Reference/estimate", "every"}};
  const auto linear = run(wave("scalar", "sin(2*x + y - 3*t)", settings));
  ASSERT_EQ(linear.records.size(), 4u);
  for (const Record &motion : linear.records)
  {
    ASSERT_EQ(motion.has("estimated error"), motion.key.method != "DGQ1") << motion.key.method;
    if (!motion.has("estimated error"))
      continue;
    const double error = motion["nodal L2 | exact"];
    EXPECT_GT(motion["estimated error"], error) << motion.key.method;
    EXPECT_LT(motion["estimated error"], 2 * error) << motion.key.method;
    EXPECT_EQ(motion["estimated error by quadrature"], 0);
    EXPECT_GT(motion["estimated error in time"], 1e-5); // Δt² is what is left of Q3's error
  }
}

TEST(Motions, of_galerkin_are_estimated_where_nothing_else_is_known)
{
  const Settings nothing_known = {{"Methods/names", "Q1, FA"},
                                  {"Problem/solution", ""},
                                  {"Problem/load", "0, 0"},
                                  {"Problem/constraint", "0, 0"},
                                  {"Problem/local solution", "none"},
                                  {"Time/initial displacement", "sin(pi*x)*sin(pi*y), 0"},
                                  {"Time/final time", "0.1"},
                                  {"Time/steps", "0.02"},
                                  {"Study/h", "0.1"},
                                  {"Study/m", "2"},
                                  {"Study/norms", "nodal L2"},
                                  {"Study/decisive error", "nodal L2 | exact"},
                                  {"Reference/method", "none"}};
  for (const std::string estimate : {"automatic", "none"})
  {
    Settings settings = nothing_known;
    settings.push_back({"Reference/estimate", estimate});
    for (const Record &motion : run(scene_of("tensor", {}, settings)).records)
      EXPECT_EQ(motion.has("estimated error"),
                estimate == "automatic" && motion.key.method == "Q1");
  }
}

// forces of all methods, of the reference and of the load come from the same f
TEST(Motions, of_double_wells_are_driven_by_a_manufactured_force_on_both_sides)
{
  const std::string both = "0.1*sin(2*pi*x)*cos(2*t), 0.1*sin(2*pi*y)*sin(t)",
                    first = "0.2*sin(2*pi*x)*cos(2*t), 0";
  for (const auto &[potential, solution] :
       {std::pair("exponential", both), {"1 - 1/(1 + r)^2", first}})
  {
    const auto results = run(torus({{"Material/potential", potential},
                                    {"Problem/solution", solution},
                                    {"Time/initial displacement", ""},
                                    {"Methods/names", "IPA-AC-R2, Q1"},
                                    {"Reference/method", "torus"},
                                    {"Study/norms", "nodal L2"},
                                    {"Study/decisive error", "nodal L2 | exact"},
                                    {"Study/h", "0.1, 0.066666666666666667"},
                                    {"Time/final time", "0.3"},
                                    {"Time/steps", "0.02"}}));
    for (const std::string method : {"IPA-AC-R2", "Q1"})
    {
      const auto of_method = errors(results, method);
      ASSERT_EQ(of_method.size(), 2u) << method << ' ' << potential;
      EXPECT_NEAR(std::log(of_method[0] / of_method[1]) / std::log(1.5), 2, .5)
          << method << ' ' << potential;
    }
    for (const Record &motion : results.records) // the torus itself is driven to the exact solution
      EXPECT_NEAR(motion["nodal L2 | reference"], motion["nodal L2 | exact"], 1e-10);
  }
}

TEST(Motions, vary_the_horizon_at_a_fixed_mesh_and_both_at_once)
{
  const Settings settings = {
      {"Methods/names", "PA-AC, IPA-AC-R2"}, {"Time/final time", "0.2"}, {"Time/steps", "0.02"}};
  Settings horizons = settings, pairs = settings;
  horizons.insert(
      horizons.end(),
      {{"Study/regime", "horizon"}, {"Study/h", "0.05"}, {"Study/horizon", "0.4, 0.3, 0.2, 0.1"}});
  pairs.insert(
      pairs.end(),
      {{"Study/regime", "delta-m"}, {"Study/h", "0.1, 0.05, 0.025"}, {"Study/m", "2, 3, 4"}});
  const auto over_horizons = run(torus(horizons));
  // fewer bonds are less exact
  const auto one_point = errors(over_horizons, "PA-AC"),
             recalibrated = errors(over_horizons, "IPA-AC-R2");
  ASSERT_EQ(one_point.size(), 4u);
  EXPECT_GT(one_point.back(), 5 * one_point.front());
  EXPECT_LT(recalibrated.back(), .3 * one_point.back());
  for (const Trend &trend : over_levels(over_horizons))
    EXPECT_EQ(trend.axis, Axis::horizon);
  EXPECT_EQ(proven(over_horizons), "none");
  horizons.push_back({"Study/horizon", "0.4, 0.2"}); // no rate without four
  for (const Trend &trend : over_levels(run(torus(horizons))))
    EXPECT_EQ(trend.verdict, "undecided");
  const auto both = errors(run(torus(pairs)), "IPA-AC-R2");
  EXPECT_LT(both.back(), .3 * both.front());
}

TEST(Motions, of_double_wells_take_data_in_a_collar)
{
  const auto results = run(torus({{"Domain/boundary", "constrained"},
                                  {"Reference/method", "none"},
                                  {"Study/decisive error", "nodal L2 | exact"},
                                  {"Problem/solution", "0.1*sin(3*x + t), 0.1*cos(2*y - t)*x"},
                                  {"Time/initial displacement", ""},
                                  {"Methods/names", "IPA-AC-R2"},
                                  {"Time/steps", "0.01"}}));
  const auto of_rule = errors(results, "IPA-AC-R2");
  EXPECT_NEAR(last_rate(of_rule), 2, .4);
  EXPECT_LT(of_rule.back(), 1e-3);
  for (const Record &motion : results.records) // the collar's work is in the balance
    EXPECT_LT(motion["energy imbalance"], 1e-3);
}

TEST(Motions, that_are_taken_over_stand_for_their_own_step)
{
  // both steps are shown as 0.02
  const auto scene = wave("scalar", "sin(2*x + y)",
                          {{"Methods/names", "FA, IPA-AC"},
                           {"Study/h", "0.2"},
                           {"Time/initial displacement", "x"},
                           {"Time/steps", "0.0200004, 0.02"}});
  const Methods methods = choose_methods(scene, meshfree::methods());
  const Analysis analysis = transient_analysis({});
  const StudyResults whole = run_study(analysis, scene, methods);
  ASSERT_EQ(whole.records.size(), 4u);
  ASSERT_EQ(whole.records[0].text("step"), whole.records[1].text("step"));
  for (std::size_t n_done = 0; n_done <= 4; ++n_done)
  {
    RunControl control;
    control.earlier.records = whole.records;
    control.earlier.records.resize(n_done);
    for (Record &motion : control.earlier.records)
      motion.cost.solve_seconds = 77; // known again
    std::size_t n_made = 0;
    control.on_made = [&](const StudyResults &made) { n_made += made.records.size(); };
    const StudyResults resumed = run_study(analysis, scene, methods, control);
    EXPECT_EQ(n_made, 4 - n_done);
    ASSERT_EQ(resumed.records.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i)
    {
      EXPECT_EQ(resumed.records[i]["time step"], whole.records[i]["time step"]);
      EXPECT_EQ(resumed.records[i]["nodal L2 | exact"], whole.records[i]["nodal L2 | exact"]);
      EXPECT_EQ(resumed.records[i].cost.solve_seconds == 77, i < n_done);
    }
  }
}

TEST(Motions, are_interrupted_between_steps)
{
  const auto scene = wave(
      "scalar", "sin(2*x + y)",
      {{"Methods/names", "FA, IPA-AC"}, {"Study/h", "0.2, 0.1"}, {"Time/steps", "0.02, 0.01"}});
  unsigned int n_made = 0;
  RunControl control;
  control.on_made = [&](const StudyResults &made) { n_made += made.records.size(); };
  control.should_stop = [&] { return n_made == 3; };
  const StudyResults results =
      run_study(transient_analysis({}), scene, choose_methods(scene, meshfree::methods()), control);
  EXPECT_FALSE(results.is_complete);
  ASSERT_EQ(results.records.size(), 3u);
  EXPECT_EQ(results.records[2].key.label(), "IPA-AC dt = 0.02");
}

// PDDO has negative eigenvalues at m = 3 and none at m = 2, though its moments are exact.
TEST(Motions, of_rules_whose_waves_grow_are_no_result)
{
  const auto of = [](const std::string &m)
  {
    return run(wave("scalar", "sin(3*x)*cos(2*y)*cos(t)",
                    {{"Methods/names", "PDDO, GMLS"},
                     {"Study/m", m},
                     {"Study/h", "0.2, 0.1"},
                     {"Time/schemes", "velocity Verlet, symplectic Euler"}}));
  };
  const StudyResults good = of("2"), bad = of("3");
  EXPECT_TRUE(good.warnings.empty());
  ASSERT_EQ(bad.warnings.size(), 1u);
  EXPECT_EQ(bad.warnings[0].find("PDDO: waves grow at h = 0.2, the smallest ω² is -"), 0u)
      << bad.warnings[0];
  for (const auto *results : {&good, &bad})
    for (const Trend &trend : over_levels(*results))
    {
      const bool is_failed = results == &bad && trend.method == "PDDO";
      EXPECT_EQ(trend.outcome == Outcome::failed, is_failed) << trend.method << ", " << trend.error;
      EXPECT_EQ(trend.verdict == "failed", is_failed) << trend.verdict;
    }
}

// At a fixed step the error in time of a first-order scheme stays where that in space falls: it is
// no statement about R2. FA's moments are wrong at any step. Its error in time known, R2's plateau
// is held against it.
TEST(Motions, a_plateau_of_the_time_step_is_not_the_methods)
{
  const auto outcomes = [](const std::string &scheme, const std::string &steps)
  {
    const StudyResults results = run(wave("scalar", "sin(2*x + y - 3*t)",
                                          {{"Methods/names", "FA, IPA-AC-R2"},
                                           {"Time/final time", "0.25"},
                                           {"Study/h", "0.2, 0.1, 0.05, 0.025"},
                                           {"Study/m", "2"},
                                           {"Time/schemes", scheme},
                                           {"Time/steps", steps}}));
    std::map<std::string, Trend> found;
    for (const Trend &trend : over_levels(results))
      if (trend.error == results.decisive_error)
        found[trend.method] = trend;
    return found;
  };
  for (const std::string steps : {"0.01", "0.01, 0.005"})
  {
    auto euler = outcomes("symplectic Euler", steps);
    EXPECT_EQ(euler.at("FA").verdict, "not AC");
    EXPECT_EQ(euler.at("IPA-AC-R2").verdict, "undecided") << euler.at("IPA-AC-R2").reason;
    EXPECT_NE(euler.at("IPA-AC-R2")
                  .reason.find(steps == "0.01" ? "its error is not known" : "its error is 0.0"),
              std::string::npos)
        << euler.at("IPA-AC-R2").reason;
  }
  EXPECT_EQ(outcomes("velocity Verlet", "0.002").at("IPA-AC-R2").verdict, "AC");
}

TEST(Motions, refuse_steps_beyond_the_critical_one_with_its_number)
{
  const auto expect_refused = [](const Settings &settings, const std::string &fragment)
  {
    try
    {
      (void)run(torus(settings));
      ADD_FAILURE() << "no error: " << fragment;
    }
    catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find(fragment), std::string::npos) << error.what();
    }
  };
  const Settings coarse = {{"Study/h", "0.1"}, {"Methods/names", "FA"}};
  const auto with = [&](Settings settings)
  {
    settings.insert(settings.begin(), coarse.begin(), coarse.end());
    return settings;
  };
  // 1.4905 ε at m = 2, see tests/meshfree/double_well_dynamics.cc
  expect_refused(with({{"Time/steps", "0.3"}}), "longer than the critical one, 0.298");
  expect_refused(with({{"Time/critical fractions", "1.1"}}), "1.1 of critical with the scheme");
  expect_refused(with({{"Time/schemes", "explicit Euler"}}), "unstable at any step");
  expect_refused(with({{"Time/schemes", "theta 0.3"}}), "unstable at any step");
  expect_refused(with({{"Time/schemes", "theta 2"}}), "'theta T' with a number T in [0, 1]");
  expect_refused(with({{"Time/schemes", "leapfrog"}}), "Time/schemes: time-stepping scheme");
}

TEST(Motions, steps_are_held_against_the_finest_level_and_each_value_of_a_variable)
{
  const auto refusal = [](const Settings &settings) -> std::string
  {
    const auto scene = torus(settings);
    try
    {
      check_transient(scene, choose_methods(scene, meshfree::methods()), 0);
      return "accepted";
    }
    catch (const InputError &error)
    {
      return error.what();
    }
  };
  // too long at all levels: the number is that of the finest, which is the shortest
  const std::string levels =
      refusal({{"Study/h", "0.1, 0.05"}, {"Methods/names", "FA"}, {"Time/steps", "0.4"}});
  EXPECT_NE(levels.find("at h = 0.05"), std::string::npos) << levels;
  // three critical steps at the first value alone, or at the last one
  for (const std::string steps : {"0.018/a", "0.9*(a/0.2)^2"})
  {
    const std::string found = refusal({{"Study/h", "0.1"},
                                       {"Methods/names", "FA"},
                                       {"Random/variables", "a: uniform 0.01 0.2"},
                                       {"Random/keys", "Time/steps: " + steps},
                                       {"Study/regime", "variable"},
                                       {"Study/variable", "a"},
                                       {"Study/values", "0.02, 0.1, 0.2"}});
    EXPECT_NE(found.find("dt = 0.9"), std::string::npos) << steps << ": " << found;
  }
}

TEST(Motions, of_a_sample_are_told_apart_by_scheme_and_step)
{
  const auto methods = [](const std::string &schemes, const std::string &steps)
  {
    const auto scene = wave("scalar", "sin(2*x + y)",
                            {{"Methods/names", "FA"},
                             {"Study/h", "0.2"},
                             {"Time/schemes", schemes},
                             {"Time/steps", steps}});
    std::vector<std::string> names;
    for (const Record &one :
         sample_study(transient_analysis({}, {true, {}}), scene, meshfree::methods()))
    {
      names.push_back(one.key.method);
      const analysis::PointField &field = sampled_field(one);
      EXPECT_EQ(field.values.size(), field.points.size());
      EXPECT_EQ(field.areas.size(), field.points.size());
      EXPECT_GT(field.values.size(), 0u);
      for (const std::string quantity : {"nodal L2 | exact", "bond energy", "kinetic energy"})
        EXPECT_EQ(one.scalars.count(quantity), 1u) << quantity;
      EXPECT_EQ(one.scalars.count("time steps"), 0u);
    }
    return names;
  };
  const std::vector<std::string> one = methods("velocity Verlet", "0.02");
  EXPECT_EQ(one, std::vector<std::string>{"FA"});
  const std::vector<std::string> all = methods("velocity Verlet, trapezoidal", "0.02, 0.01");
  EXPECT_EQ(all, (std::vector<std::string>{
                     "FA velocity Verlet, dt = 0.02", "FA velocity Verlet, dt = 0.01",
                     "FA trapezoidal, dt = 0.02", "FA trapezoidal, dt = 0.01"}));
  EXPECT_EQ(methods("trapezoidal", "0.02, 0.01"),
            (std::vector<std::string>{"FA dt = 0.02", "FA dt = 0.01"}));
}

TEST(Motions, over_a_variable_are_those_of_scenes_at_its_values)
{
  // loads, initial states, steps and the torus change with it
  const Settings axis = {{"Random/variables", "a: uniform 0.01 0.02"},
                         {"Random/keys", "Time/steps: 0.0002/a"},
                         {"Methods/names", "IPA-AC-R2, Q1"},
                         {"Time/initial displacement", ""},
                         {"Time/initial velocity", ""},
                         {"Study/regime", "delta"},
                         {"Problem/solution", "a*cos(2*pi*t)*sin(2*pi*x), 0"},
                         {"Study/h", "0.1"},
                         {"Study/m", "3"},
                         {"Study/norms", "nodal L2"},
                         {"Study/decisive error", "nodal L2 | exact"},
                         {"Reference/method", "torus"},
                         {"Time/final time", "0.1"}};
  Settings over = axis;
  over.insert(
      over.end(),
      {{"Study/regime", "variable"}, {"Study/variable", "a"}, {"Study/values", "0.01, 0.02"}});
  const auto results = run(torus(over));
  ASSERT_EQ(results.records.size(), 2 * 2u);
  EXPECT_NE(results.records[0]["reference change"], results.records[1]["reference change"]);
  for (const Record &motion : results.records)
  {
    Settings at = axis;
    at.push_back({"Random/values", motion.key.value == .01 ? "0.01" : "0.02"});
    for (const Record &other : run(torus(at)).records)
      if (other.key.method == motion.key.method)
      {
        for (const std::string name :
             {"nodal L2 | exact", "nodal L2 | reference", "velocity nodal L2 | exact",
              "velocity nodal L2 | reference", "time step"})
          EXPECT_EQ(motion[name], other[name])
              << motion.key.method << ", a = " << motion.key.value << ", " << name;
      }
  }
  for (const Trend &trend : over_levels(results))
    EXPECT_EQ(std::pair(trend.axis, trend.verdict.substr(0, 8)),
              std::pair(Axis::variable, std::string("at most ")));
}
