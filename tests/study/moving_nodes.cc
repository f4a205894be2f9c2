// Motions of scattered nodes, meshes and free bodies: the same equations as on lattices.

#include "analysis/transient.h"
#include "meshfree/method.h"
#include "method/discretisation.h"
#include "reference/method.h"
#include "study/motion_data.h"
#include "study/preflight.h"
#include "study/transient.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

using namespace plumbline;
using namespace plumbline::study;

namespace
{
  using Settings = std::vector<scene::Override>;

  scene::Scene scene_of(const std::string &model, const Settings &settings)
  {
    Settings all = {{"Time/final time", "0.5"},
                    {"Study/regime", "delta"},
                    {"Study/h", "0.2, 0.1, 0.05"},
                    {"Study/norms", "nodal L2"},
                    {"Study/decisive error", "nodal L2 | exact"}};
    all.insert(all.end(), settings.begin(), settings.end());
    return scene::parse_scene("t.prm", model.empty() ? "" : scene::scene_template(model), all);
  }

  Methods methods_of(const scene::Scene &scene)
  {
    Methods all = meshfree::methods();
    for (const auto &method : reference::methods())
      all.push_back(method);
    return choose_methods(scene, all);
  }

  StudyResults run(const scene::Scene &scene)
  {
    const Methods methods = methods_of(scene);
    check_transient(scene, methods, 0);
    const StudyResults results = run_study(transient_analysis({}), scene, methods);
    for (const Record &record : results.records)
      EXPECT_EQ(record.failure, "") << record.key.label();
    return results;
  }

  /// Where nodes are, and u there.
  using Places = std::vector<std::pair<std::array<double, 2>, std::vector<double>>>;

  /// The state at the end of the coarsest level, nodes sorted by place.
  Places end_of(const scene::Scene &scene)
  {
    ProblemsInTime<2>::Loads loads;
    ProblemsInTime<2> problems(scene, 0, scene.study.series[0].levels[0], loads);
    const auto discretisation = methods_of(scene)[0]->discretise(problems.at(0));
    const auto equation = discretisation->motion(scene.time.is_lumped);
    const MotionData<2> data = motion_data<2>(scene, *equation, problems);
    const analysis::Transient transient(*equation, data.drive, scene.time.density,
                                        scene.time.damping);
    analysis::State state = data.start;
    analysis::integrate(transient.motion(), analysis::scheme("velocity Verlet"), {.01},
                        scene.time.final_time, state);
    const auto u = equation->nodal(state.u);
    const unsigned int n = equation->n_components();
    Places places;
    for (std::size_t i = 0; i < equation->nodes().size(); ++i)
    {
      const auto &x = equation->nodes()[i];
      places.push_back({{std::round(x[1] * 1e6), std::round(x[0] * 1e6)}, {}});
      for (unsigned int c = 0; c < n; ++c)
        places.back().second.push_back(u[i * n + c]);
    }
    std::sort(places.begin(), places.end());
    return places;
  }

  std::vector<double> errors(const StudyResults &results, const std::string &method)
  {
    for (const Trend &trend : results.trends)
      if (trend.method == method && trend.error == results.decisive_error)
        return trend.values;
    throw InputError("no such trend: " + method);
  }

  double last_error(const StudyResults &results, const std::string &method)
  {
    return errors(results, method).back();
  }

  double last_rate(const StudyResults &results, const std::string &method)
  {
    const auto of_method = errors(results, method);
    return std::log2(of_method[of_method.size() - 2] / of_method.back());
  }
} // namespace

namespace
{
  /// How far a method moves nodes of a lattice elsewhere on squares than on the lattice.
  void expect_alike(const std::string &model, const std::string &method, const std::string &mass,
                    const Settings &more = {})
  {
    // loads of Galerkin methods on meshes are quadrature, and masses are factored
    const double tolerance = method == "Q1" || method == "DGQ1" ? 2e-11 : 1e-12;
    Places ends[2];
    for (const bool is_mesh : {false, true})
    {
      Settings settings = {
          {"Methods/names", method},
          {"Domain/mesh", is_mesh ? "squares" : "lattice"},
          {"Problem/solution", model.empty() ? "sin(2*x + y - 3*t)" : "x*y*sin(t), x*cos(t)"},
          {"Study/m", "2.5"},
          {"Time/mass", mass},
          {"Time/density", "2"},
          {"Time/damping", "0.3"},
          {"Reference/method", "none"}};
      settings.insert(settings.end(), more.begin(), more.end());
      ends[is_mesh ? 1 : 0] = end_of(scene_of(model, settings));
    }
    ASSERT_EQ(ends[0].size(), ends[1].size()) << method;
    double difference = 0, size = 0;
    for (std::size_t i = 0; i < ends[0].size(); ++i)
      for (std::size_t c = 0; c < ends[0][i].second.size(); ++c)
      {
        EXPECT_EQ(ends[0][i].first, ends[1][i].first);
        // nodes of discontinuous methods share a place: their values are sorted
        difference = std::max(difference, std::abs(ends[0][i].second[c] - ends[1][i].second[c]));
        size = std::max(size, std::abs(ends[0][i].second[c]));
      }
    EXPECT_GT(size, .2);
    EXPECT_LT(difference, tolerance) << method << ' ' << mass << ' ' << model;
  }
} // namespace

TEST(MovingNodes, of_a_lattice_move_as_the_lattice_does)
{
  for (const std::string method : {"FA", "PA-AC", "IPA-AC-R2"})
    for (const std::string model : {"", "tensor"})
      expect_alike(model, method, "consistent");
  for (const std::string mass : {"consistent", "lumped"})
    expect_alike("", "Q1", mass);
  expect_alike("", "DGQ1", "consistent");
}

namespace
{
  const Settings wells_in_a_collar = {{"Domain/boundary", "constrained"},
                                      {"Time/initial displacement", ""}};

  /// Double wells at rest in a collar, on moved nodes.
  Settings moved_wells(const std::string &method, const Settings &more)
  {
    Settings settings = wells_in_a_collar;
    settings.insert(settings.end(), {{"Methods/names", method},
                                     {"Methods/perturbation", "0.3"},
                                     {"Domain/mesh", "squares"},
                                     {"Reference/method", "none"},
                                     {"Study/m", "2.5"}});
    settings.insert(settings.end(), more.begin(), more.end());
    return settings;
  }
} // namespace

TEST(MovingNodes, of_double_wells_move_as_those_of_the_lattice_do)
{
  for (const std::string method : {"FA", "IPA-AC", "IPA-AC-R2"})
    expect_alike("double-well", method, "consistent", wells_in_a_collar);
  Settings fading = wells_in_a_collar;
  fading.insert(fading.end(), {{"Material/boundary function", "smoothstep"},
                               {"Material/potential", "r/(1 + r)"},
                               {"Problem/load", "sin(t)*y, 0"}});
  expect_alike("double-well", "PA-AC", "consistent", fading);
}

TEST(MovingNodes, of_double_wells_converge_where_moments_are_exact)
{
  const auto results = run(scene_of(
      "double-well", moved_wells("FA, IPA-AC-R2", {{"Problem/solution",
                                                    "0.2*sin(2*x + y - 2*t), 0.1*cos(x - 2*y + t)"},
                                                   {"Time/critical fractions", "0.25"}})));
  EXPECT_NEAR(last_rate(results, "IPA-AC-R2"), 2, .4);
  EXPECT_LT(last_error(results, "IPA-AC-R2"), .3 * last_error(results, "FA"));
  // weights of FA are the same from both ends: its books balance, to the rule of work over steps
  const Record &finest = results.records[2]; // of three levels
  EXPECT_EQ(finest.key.method, "FA");
  EXPECT_LT(finest["energy imbalance"], 1e-3);
}

TEST(MovingNodes, with_two_weights_to_a_bond_are_warned_of)
{
  const Settings quick = {{"Problem/solution", "0.2*sin(2*x + y - 2*t), 0.1*cos(x - 2*y + t)"},
                          {"Study/h", "0.2"},
                          {"Time/final time", "0.1"}};
  const auto wells = run(scene_of("double-well", moved_wells("FA, IPA-AC-R2", quick)));
  ASSERT_EQ(wells.records.size(), 2u);
  EXPECT_EQ(wells.records[0]["symmetric"] == 1, wells.records[0].key.method == "FA");
  EXPECT_EQ(wells.records[1]["symmetric"] == 1, wells.records[1].key.method == "FA");
  ASSERT_EQ(wells.warnings.size(), 1u);
  EXPECT_EQ(wells.warnings[0].find("IPA-AC-R2: the operator is not symmetric"), 0u);
  // linear ones as well; once for a method, whatever its levels
  const auto linear = run(scene_of("", {{"Methods/names", "FA, IPA-AC-R2"},
                                        {"Methods/perturbation", "0.3"},
                                        {"Domain/mesh", "squares"},
                                        {"Problem/solution", "x*t"},
                                        {"Study/h", "0.2, 0.1"},
                                        {"Time/final time", "0.1"}}));
  EXPECT_EQ(linear.warnings.size(), 1u);
  const auto lattice = run(scene_of("", {{"Methods/names", "IPA-AC-R2"},
                                         {"Problem/solution", "x*t"},
                                         {"Study/h", "0.2"},
                                         {"Time/final time", "0.1"}}));
  EXPECT_TRUE(lattice.warnings.empty());
}

TEST(MovingNodes, of_double_wells_have_the_slope_of_their_energy_for_a_force)
{
  // where a bond's two weights differ, its energy is that of their mean, as the tangent is
  for (const std::string potential : {"exponential", "r/(1 + r)"})
    for (const std::string method : {"FA", "PA-AC"})
    {
      const scene::Scene scene =
          scene_of("double-well",
                   moved_wells(method, {{"Problem/solution", "0.3*sin(4*x)*y, 0.2*x*y*(1 + t)"},
                                        {"Material/potential", potential},
                                        {"Study/h", "0.2"}}));
      ProblemsInTime<2>::Loads loads;
      ProblemsInTime<2> problems(scene, 0, scene.study.series[0].levels[0], loads);
      const auto discretisation = methods_of(scene)[0]->discretise(problems.at(0));
      const auto equation = discretisation->motion(false);
      EXPECT_EQ(equation->is_symmetric(), method == "FA");
      std::vector<double> g = equation->drive(problems.at(0));
      std::fill(g.begin(), g.begin() + static_cast<std::ptrdiff_t>(equation->size()), 0.);
      const std::vector<double> u = equation->state(*problems.at(0).solution);
      std::vector<double> v(u.size()), w(u.size()), force, along_v, along_w;
      for (std::size_t i = 0; i < u.size(); ++i)
      {
        v[i] = std::sin(static_cast<double>(3 * i));
        w[i] = std::cos(static_cast<double>(5 * i));
      }
      const double step = 2e-6;
      const auto moved = [&](double by)
      {
        std::vector<double> there = u;
        analysis::add(there, by, v);
        return there;
      };
      equation->acceleration(u, g, force);
      equation->tangent(u, g, v, along_v);
      equation->tangent(u, g, w, along_w);
      const double scale = analysis::norm(v) * analysis::norm(along_v);
      EXPECT_NEAR(equation->product(w, along_v), equation->product(v, along_w), 1e-12 * scale);
      const double slope =
          (equation->energy(moved(step), g) - equation->energy(moved(-step), g)) / (2 * step);
      const double difference = std::abs(slope + equation->product(force, v)) / std::abs(slope);
      EXPECT_EQ(difference < 1e-7, method == "FA") << difference;
      std::vector<double> after, before;
      equation->acceleration(moved(step), g, after);
      equation->acceleration(moved(-step), g, before);
      analysis::add(after, -1, before);
      // v·A v is that of A's symmetric part
      EXPECT_NEAR(equation->product(v, after) / (2 * step), equation->product(v, along_v),
                  1e-8 * scale);
    }
}

TEST(MovingNodes, hold_manufactured_fields_that_their_rule_maps_exactly)
{
  // degree 2 on moved nodes: errors are those of time and of rounding
  const auto results = run(scene_of("", {{"Methods/names", "IPA-AC-R2"},
                                         {"Methods/perturbation", "0.3"},
                                         {"Domain/mesh", "squares"},
                                         {"Problem/solution", "(1 + x)*(2 - y)*sin(2*t) + x^2"},
                                         {"Study/h", "0.1"},
                                         {"Study/m", "3"},
                                         {"Time/density", "1.7"},
                                         {"Time/damping", "0.6"},
                                         {"Time/schemes", "Runge-Kutta"}}));
  ASSERT_EQ(results.records.size(), 1u);
  EXPECT_LT(results.records[0]["nodal L2 | exact"], 1e-9);
  EXPECT_LT(results.records[0]["velocity nodal L2 | exact"], 1e-8);
}

TEST(MovingNodes, converge_as_in_statics)
{
  const std::string solution = "sin(2*x + y - 3*t)";
  const auto moved = run(scene_of("", {{"Methods/names", "FA, IPA-AC-R2"},
                                       {"Methods/perturbation", "0.3"},
                                       {"Domain/mesh", "squares"},
                                       {"Problem/solution", solution},
                                       {"Study/m", "3"},
                                       {"Time/critical fractions", "0.5"}}));
  EXPECT_NEAR(last_rate(moved, "IPA-AC-R2"), 2, .4);
  EXPECT_LT(last_error(moved, "IPA-AC-R2"), .6 * last_error(moved, "FA"));
  const auto triangles = run(scene_of("", {{"Methods/names", "P1"},
                                           {"Domain/mesh", "triangles"},
                                           {"Problem/solution", solution},
                                           {"Quadrature/tolerance", "1e-2"},
                                           {"Study/m", "2"}}));
  EXPECT_NEAR(last_rate(triangles, "P1"), 2, .4);
}

TEST(MovingNodes, of_galerkin_know_that_rough_motions_converge_slowly)
{
  // u jumps at the boundary, where continuous functions cannot: changes to h/2 and degree p + 1
  // are far smaller than errors
  const auto rough = [](const std::string &h)
  {
    return scene_of("tensor", {{"Methods/names", "Q1"},
                               {"Problem/solution", ""},
                               {"Problem/load", "0, 0"},
                               {"Problem/constraint", "0, 0"},
                               {"Problem/local solution", "none"},
                               {"Time/initial displacement", "sin(pi*x)*sin(pi*y), 0"},
                               {"Time/final time", "0.2"},
                               {"Time/steps", "0.01"},
                               {"Study/regime", "m"},
                               {"Study/horizon", "0.2"},
                               {"Study/h", h},
                               {"Reference/method", "none"}});
  };
  const Places coarse = end_of(rough("0.1")), fine = end_of(rough("0.0125"));
  std::map<std::array<double, 2>, std::vector<double>> at(fine.begin(), fine.end());
  double sum = 0;
  for (const auto &[place, u] : coarse)
    for (unsigned int c = 0; c < 2; ++c)
      sum += std::pow(u[c] - at.at(place)[c], 2);
  const double error = std::sqrt(sum / static_cast<double>(coarse.size()));
  const Record motion = run(rough("0.1")).records.at(0);
  ASSERT_TRUE(motion.has("estimated error"));
  EXPECT_GT(motion["estimated error"], error);
  EXPECT_LT(motion["estimated error"], 10 * error);
}

TEST(MovingNodes, keep_energy_where_their_operator_is_symmetric)
{
  const Settings free_motion = {{"Methods/perturbation", "0.3"},
                                {"Domain/mesh", "squares"},
                                {"Problem/solution", ""},
                                {"Problem/load", "0, 0"},
                                {"Problem/constraint", "0, 0"},
                                {"Problem/local solution", "none"},
                                {"Time/initial displacement", "sin(pi*x)*sin(pi*y), 0"},
                                {"Time/final time", "20"},
                                {"Time/critical fractions", "0.5, 0.25"},
                                {"Reference/method", "none"},
                                {"Study/h", "0.1"},
                                {"Study/m", "2.5"}};
  const auto swing = [](const Record &motion, double from, double to)
  {
    const auto stored = [](const analysis::Energies &e) { return e.kinetic + e.bond; };
    double largest = 0;
    const std::vector<analysis::Energies> energies = energies_of(motion);
    for (const analysis::Energies &now : energies)
      if (now.t >= from && now.t <= to)
        largest = std::max(largest, std::abs(stored(now) / stored(energies[0]) - 1));
    return largest;
  };
  Settings settings = free_motion;
  settings.push_back({"Methods/names", "FA"});
  const auto results = run(scene_of("tensor", settings));
  ASSERT_EQ(results.records.size(), 2u);
  const double coarse = swing(results.records[0], 0, 20), fine = swing(results.records[1], 0, 20);
  EXPECT_LT(coarse, .05);
  EXPECT_NEAR(coarse / fine, 4, 1); // second order
  EXPECT_LT(swing(results.records[1], 10, 20),
            1.2 * swing(results.records[1], 0, 10) + 1e-6); // no drift

  // two weights a bond: no tangent that is symmetric
  settings.back().value = "PA-AC";
  settings.push_back({"Time/schemes", "trapezoidal"});
  try
  {
    (void)run(scene_of("tensor", settings));
    ADD_FAILURE() << "not refused";
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("needs a symmetric tangent of forces, which PA-AC"),
              std::string::npos)
        << error.what();
  }
}

TEST(MovingNodes, of_a_body_that_floats_go_on_as_they_begin)
{
  // no force on a rigid translation, whatever the shape
  const auto results = run(scene_of("variational", {{"Domain/boundary", "free"},
                                                    {"Domain/fixed", "none"},
                                                    {"Domain/boxes", "0, 0 : 1, 1"},
                                                    {"Domain/mesh", "lattice"},
                                                    {"Methods/nodes", "vertices"},
                                                    {"Methods/names", "FA, DGQ0"},
                                                    {"Problem/solution", ""},
                                                    {"Problem/load", "0, 0"},
                                                    {"Problem/constraint", "0, 0"},
                                                    {"Problem/local solution", "none"},
                                                    {"Reference/method", "none"},
                                                    {"Study/h", "0.1"},
                                                    {"Study/m", "2"},
                                                    {"Time/initial velocity", "0.25, -0.5"},
                                                    {"Time/density", "3"}}));
  ASSERT_EQ(results.records.size(), 2u);
  for (const Record &motion : results.records)
  {
    EXPECT_LT(motion["extent of u"], 1e-12) << motion.key.method; // u is the same everywhere
    EXPECT_NEAR(motion["kinetic energy"], .5 * 3 * (.25 * .25 + .5 * .5), 1e-9)
        << motion.key.method;
    EXPECT_LT(motion["bond energy"], 1e-12) << motion.key.method;
  }
}
