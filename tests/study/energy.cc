// Energies of solutions, and errors in the energy norm: against sums over bonds, Galerkin
// orthogonality, nested spaces, and what theory says of rules whose moments are wrong.
#include "study/energy.h"

#include "report/tables.h"
#include "scene/problem.h"
#include "study/equations.h"
#include "study/solution_record.h"
#include "study/trend.h"
#include "tests/study/operators.h"
#include "tests/study/space_scene.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::study;

namespace
{
  using in_space::Settings;
  using in_space::with;

  const Settings scalar = {{"Kernel/type", "linear-decay"},
                           {"Kernel/limit", "-1/2 Laplace"},
                           {"Study/norms", "nodal Linf, averages L2, energy"}};
  const Settings of_solution = with(scalar, {{"Study/decisive error", "energy | exact"}});
  /// Without a known solution.
  const Settings of_load =
      with(scalar, {{"Problem/constraint", "0"},
                    {"Problem/local solution", "none"},
                    {"Study/decisive error", "averages L2 | own finest level"}});

  scene::Scene parsed(const Settings &settings)
  {
    return scene::parse_scene("test.prm", "", settings);
  }

  StudyResults results_of(const Settings &settings)
  {
    return in_space::run(parsed(settings));
  }

  const Trend &trend_of(const StudyResults &results, const std::string &method,
                        const std::string &error = "energy | exact")
  {
    return *std::find_if(results.trends.begin(), results.trends.end(),
                         [&](const Trend &one)
                         { return one.method == method && one.error == error; });
  }

  /// c (1 - r/δ) with ∫ C ξ_1² = 1 in the plane.
  double linear_decay(double r, double horizon)
  {
    return r < horizon ? 20 / (M_PI * std::pow(horizon, 4)) * (1 - r / horizon) : 0;
  }

  /// FA's second moment over the ball's.
  double moment_ratio(int m)
  {
    double sum = 0;
    for (int j = -m; j <= m; ++j)
      for (int i = -m; i <= m; ++i)
        sum += linear_decay(std::hypot(i, j), m) * i * i;
    return sum;
  }
} // namespace

// FA on the centres of 4 × 4 cells, and their neighbours around, pair by pair.
TEST(Energy, is_half_the_sum_over_bonds_that_touch_the_domain)
{
  constexpr int n = 4, m = 2;
  constexpr double h = .25, horizon = m * h;
  const Record record = results_of(with(of_solution, {{"Methods/names", "FA"},
                                                      {"Problem/solution", "7 + x^2 + x*y"},
                                                      {"Study/regime", "delta"},
                                                      {"Study/m", "2"},
                                                      {"Study/h", "0.25"}}))
                            .records.front();
  const auto u = [](int i, int j)
  {
    const double x = (i + .5) * h, y = (j + .5) * h;
    return 7 + x * x + x * y;
  };
  const auto is_free = [](int i, int j) { return i >= 0 && i < n && j >= 0 && j < n; };
  double energy = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      for (int l = -m; l <= m; ++l)
        for (int k = -m; k <= m; ++k)
          energy += (is_free(i + k, j + l) ? .25 : .5) * std::pow(h, 4) *
                    (k == 0 && l == 0 ? 0 : linear_decay(h * std::hypot(k, l), horizon)) *
                    std::pow(u(i + k, j + l) - u(i, j), 2);
  EXPECT_NEAR(record["energy of exact"], energy, 1e-12 * energy);
  EXPECT_NEAR(record["energy"], energy, .2 * energy); // of another field
  EXPECT_NEAR(record["energy size"], std::sqrt(2 * record["energy"]), 1e-14);
}

// A e = (1 - C(m)) b for a quadratic, C(m) the ratio of second moments: e is that times the
// solution z of A z = b around which z = 0. So is its energy norm, and FA is not AC.
TEST(Energy, of_a_quadratic_is_wrong_by_the_second_moment)
{
  const Settings levels = {{"Methods/names", "FA, IPA-AC-R2"},
                           {"Study/regime", "delta"},
                           {"Study/m", "3"},
                           {"Study/h", "0.2, 0.1, 0.05, 0.025"}};
  const StudyResults results = results_of(
                         with(with(of_solution, levels), {{"Problem/solution", "x^2 + y^2"}})),
                     torsion = results_of(with(with(of_load, levels), {{"Problem/load", "-2"}}));
  const double excess = std::abs(moment_ratio(3) - 1);
  EXPECT_GT(excess, .01);
  for (std::size_t i = 0; i < results.records.size(); ++i)
  {
    const Record &record = results.records[i], &z = torsion.records[i];
    ASSERT_EQ(record.key.label(), z.key.label());
    if (record.key.method == "FA")
    {
      EXPECT_NEAR(record["energy | exact"], excess * z["energy size"], 1e-9 * z["energy size"]);
    }
    else
    {
      EXPECT_LE(record["energy | exact"], round_off_of(record, "energy | exact"));
    }
  }
  EXPECT_EQ(trend_of(results, "FA").outcome, Outcome::stalls);
  EXPECT_EQ(trend_of(results, "IPA-AC-R2").outcome, Outcome::converges);
  EXPECT_EQ(verdict_of(scene::Regime::delta, trend_of(results, "FA")), "not AC");
}

// Where u = 0 around Ω, a(u, u) of a solution is its work: b·u, of rules Σ V b u.
TEST(Energy, is_half_the_work_of_the_load)
{
  const Settings levels = {{"Study/regime", "delta"}, {"Study/m", "2"}, {"Study/h", "0.25"}};
  for (const std::string model : {"LPS", "bonds"})
  {
    const Settings solid = model == "LPS"
                               ? Settings{{"Kernel/type", "1/r"},    {"Kernel/limit", "Navier"},
                                          {"Material/model", "LPS"}, {"Material/E", "3 + x"},
                                          {"Material/nu", "0.3"},    {"Domain/mesh", "squares"},
                                          {"Problem/load", "1, 3"},  {"Problem/constraint", "0, 0"}}
                               : Settings{{"Problem/load", "3"}};
    const scene::Scene scene =
        parsed(with(with(of_load, levels), with(solid, {{"Methods/names", "PA-AC"}})));
    const double energy = in_space::run(scene).records.front()["energy"];
    const problem::Problem<2> problem = scene::make_problem(scene, 0, {.25, .5});
    const auto own = analysis::solve(*method_of("PA-AC"), problem);
    double work = 0;
    for (std::size_t i = 0; i < own.nodal.size(); ++i)
      work += .25 * .25 * own.nodal[i] *
              problem.load.value(own.nodes[i / problem.n_components], i % problem.n_components);
    EXPECT_NEAR(energy, .5 * work, 1e-9 * work) << model;
  }
}

// With u = 0 around Ω and exact entries: a(u - u_H, u - u_H) = a(u, u) - a(u_H, u_H) for a solution
// u of a space that holds the coarse one (Céa), and energies rise from level to level.
TEST(Energy, of_nested_galerkin_solutions_is_orthogonal)
{
  const scene::Scene scene = parsed(with(of_load, {{"Methods/names", "Q1, DGQ0, DGQ1"},
                                                   {"Problem/load", "1 + 5*x*y"},
                                                   {"Study/regime", "m"},
                                                   {"Study/horizon", "0.5"},
                                                   {"Study/h", "0.25, 0.125, 0.0625"}}));
  const StudyResults results = in_space::run(scene);
  std::map<std::string, std::vector<double>> energies;
  for (const Record &record : results.records)
    energies[record.key.method].push_back(record["energy"]);
  for (const auto &[name, of] : energies)
    EXPECT_TRUE(of.size() == 3 && 0 < of[0] && of[0] < of[1] && of[1] < of[2]) << name;
  // DGQ1 holds both other spaces; several of its nodes lie at one place
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_GT(energies["DGQ1"][i], std::max(energies["Q1"][i], energies["DGQ0"][i])) << i;
  for (const std::string name : {"Q1", "DGQ0"})
  {
    const auto method = method_of(name);
    const auto fine = scene::make_problem(scene, 0, {.125, .5}),
               coarse = scene::make_problem(scene, 0, {.25, .5});
    const auto u = analysis::solve(*method, fine), u_H = analysis::solve(*method, coarse);
    const auto of = equations_of(*method, fine);
    std::vector<double> difference;
    for (std::size_t i = 0; i < u.nodes.size(); ++i)
    {
      ASSERT_LT(u.nodes[i].distance(of.nodes[i]), 1e-12);
      difference.push_back(u.nodal[i] - u_H.value(u.nodes[i], 0));
    }
    const auto norm = energy_norm(of, difference);
    ASSERT_TRUE(norm);
    const std::vector<double> &E = energies[name];
    EXPECT_GT(*norm, 1e-3) << name;
    EXPECT_NEAR(*norm * *norm, 2 * (E[1] - E[0]), 1e-9 * E[1]) << name;
  }
}

// At a fixed horizon the energy norm is equivalent to that of L2 for an integrable kernel (Du et
// al. 2012, doi:10.1137/110833294): the order is that of nodal values, 2. Rules whose second
// moments are right have that order at a fixed m, too.
TEST(Energy, falls_in_the_order_of_the_method)
{
  const Settings field = {{"Problem/solution", "sin(3*x)*cos(2*y)"},
                          {"Study/h", "0.2, 0.1, 0.05, 0.025"}};
  const StudyResults at_horizon =
                         results_of(with(with(of_solution, field), {{"Methods/names", "IPA-AC, Q1"},
                                                                    {"Study/regime", "m"},
                                                                    {"Study/horizon", "0.4"}})),
                     at_ratio = results_of(
                         with(with(of_solution, field), {{"Methods/names", "IPA-AC, IPA-AC-R2, Q1"},
                                                         {"Study/regime", "delta"},
                                                         {"Study/m", "3"}}));
  for (const std::string name : {"IPA-AC", "Q1"})
    EXPECT_NEAR(trend_of(at_horizon, name).rate, 2, .25) << name;
  for (const std::string name : {"IPA-AC-R2", "Q1"})
    EXPECT_NEAR(trend_of(at_ratio, name).rate, 2, .25) << name;
  EXPECT_EQ(trend_of(at_ratio, "IPA-AC").outcome, Outcome::stalls);
  // relative to the energy norm of the solution, not to its variation
  const Record &record = at_ratio.records.front();
  EXPECT_EQ(size_of(record, "energy | exact"), record["energy size"]);
}

// Pflug, Stingl & Zetzmann 2026, lemma 3.19: u·Bu = 2 Σ V_i W_i with their potential (33), for one-
// point rules on a body with a free boundary. α = 8μ/m, k = λ + μ.
TEST(Energy, of_a_body_is_the_potential_of_the_variational_model)
{
  constexpr double h = .125, horizon = .25, k = 100, l = 800;
  const scene::Scene scene = parsed({{"Domain/boxes", "0, 0 : 1, 0.5"},
                                     {"Domain/boundary", "free"},
                                     {"Domain/fixed", "0, 0 : 0.25, 0.5"},
                                     {"Kernel/type", "1/r"},
                                     {"Kernel/limit", "Navier"},
                                     {"Material/model", "variational"},
                                     {"Material/k", "100"},
                                     {"Material/l", "800"},
                                     {"Problem/load", "10*x, 3"},
                                     {"Problem/constraint", "0, 0"},
                                     {"Problem/local solution", "none"},
                                     {"Methods/names", "FA"},
                                     {"Methods/nodes", "vertices"},
                                     {"Study/regime", "m"},
                                     {"Study/h", "0.125"},
                                     {"Study/horizon", "0.25"},
                                     {"Study/norms", "averages L2, energy"},
                                     {"Study/decisive error", "averages L2 | own finest level"}});
  const Record record = in_space::run(scene).records.front();
  const auto problem = scene::make_problem(scene, 0, {h, horizon});
  const auto solution = analysis::solve(*method_of("FA"), problem);
  const auto &cells = *problem.cells();
  const auto u = [&](std::size_t i)
  {
    dealii::Tensor<1, 2> value;
    for (std::size_t p = 0; p < solution.nodes.size(); ++p)
      if (solution.nodes[p].distance(cells.nodes[i]) < 1e-9)
        value = dealii::Point<2>(solution.nodal[2 * p], solution.nodal[2 * p + 1]);
    return value;
  };
  const auto for_bonds = [&](std::size_t i, const auto &f)
  {
    for (std::size_t j = 0; j < cells.size(); ++j)
    {
      const dealii::Tensor<1, 2> xi = cells.nodes[j] - cells.nodes[i];
      if (j != i && xi.norm() <= horizon * (1 + 1e-9))
        f(xi, cells.area[j] / xi.norm(), u(j) - u(i));
    }
  };
  double sum = 0;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    double mass = 0, theta = 0, shear = 0;
    for_bonds(i, [&](const auto &xi, double w, const auto &) { mass += w * xi.norm_square(); });
    for_bonds(i,
              [&](const auto &xi, double w, const auto &du) { theta += 2 / mass * w * (xi * du); });
    for_bonds(i,
              [&](const auto &xi, double w, const auto &du) {
                shear += w * xi.norm_square() * std::pow(xi * du / xi.norm_square() - theta / 2, 2);
              });
    sum += cells.area[i] * (.5 * k * theta * theta + .5 * l / mass * shear);
  }
  EXPECT_GT(sum, 0);
  EXPECT_NEAR(record["energy"], sum, 1e-8 * sum);
}

TEST(Energy, is_found_in_space_too)
{
  const Settings settings = {{"Kernel/type", "linear-decay"},
                             {"Kernel/limit", "-1/2 Laplace"},
                             {"Methods/names", "FA, IPA-AC-R2, Q1"},
                             {"Study/regime", "delta"},
                             {"Study/m", "2"},
                             {"Study/h", "1/4, 1/8"},
                             {"Study/norms", "nodal Linf, averages L2, energy"}};
  const StudyResults results = in_space::run(
                         in_space::make_scene(with(settings, {{"Problem/solution", "x^2 + y*z"}}))),
                     torsion = in_space::run(in_space::make_scene(
                         with(settings, {{"Problem/solution", "0"}, {"Problem/load", "-1"}})));
  double moment = 0; // as in truncation.cc
  for (int k = -2; k <= 2; ++k)
    for (int j = -2; j <= 2; ++j)
      for (int i = -2; i <= 2; ++i)
        moment += std::max(0., 1 - std::sqrt(i * i + j * j + k * k) / 2) * i * i;
  moment *= 90 / (4 * M_PI * 32);
  for (std::size_t i = 0; i < results.records.size(); ++i)
  {
    const Record &record = results.records[i];
    const double error = record["energy | exact"], z = torsion.records[i]["energy size"];
    EXPECT_GT(record["energy"], 0);
    EXPECT_GT(z, 0);
    if (record.key.method == "FA")
    {
      EXPECT_NEAR(error, std::abs(1 - moment) * z, 1e-8 * z);
    }
    if (record.key.method == "IPA-AC-R2")
    {
      EXPECT_LE(error, round_off_of(record, "energy | exact"));
    }
  }
}

// No root of a negative number, and none of what round-off makes negative.
TEST(Energy, of_an_operator_that_is_not_positive_definite_is_no_norm)
{
  method::LinearEquations<2> of;
  of.n_free = 2;
  of.rows.start = {0, 2, 4};
  of.rows.column = {0, 1, 0, 1};
  of.rows.value = {1, -3, -1, 1}; // the symmetric part has the eigenvalue -1
  of.volumes = {.5, .5};
  EXPECT_FALSE(energy_norm(of, {1, 1}));
  ASSERT_TRUE(energy_norm(of, {1, -1}));
  EXPECT_NEAR(*energy_norm(of, {1, -1}), std::sqrt(.5 * 6), 1e-15);
  of.rows.value = {1, -1, -1, 1};
  EXPECT_LT(energy_norm(of, {.1, .1 * (1 + 1e-16)}).value_or(1), 1e-7);
}

TEST(Energy, has_a_table_that_says_where_there_is_no_norm)
{
  StudyResults results;
  Record record;
  EXPECT_TRUE(report::energy_table(results).rows.empty());
  results.records.push_back(record); // without the norm
  for (const double value : {2., 8.})
  {
    record.set("energy", value);
    record.set("energy of local", 4);
    record.set("energy size", 2 * std::sqrt(value));
    if (value > 4)
      record.set("energy | local", 1);
    results.records.push_back(record);
  }
  const report::Table table = report::energy_table(results);
  ASSERT_EQ(table.rows.size(), 2u);
  const std::size_t n = table.columns.size();
  EXPECT_EQ(table.rows[0][n - 2].text, "none: not positive definite");
  EXPECT_EQ(table.rows[0][n - 3].csv.front(), "-0.5");
  EXPECT_EQ(table.rows[1][n - 2].csv.front(), "1");
  EXPECT_NEAR(std::stod(table.rows[1][n - 1].csv.front()), 1 / std::sqrt(32), 1e-15);
  record.scalars.erase("energy of local"); // no known solution
  results.records = {record};
  EXPECT_EQ(report::energy_table(results).rows.size(), 1u);
}

TEST(Energy, is_refused_without_a_known_solution_to_compare_with)
{
  const Settings settings = {
      {"Kernel/type", "linear-decay"}, {"Problem/solution", "x"},
      {"Methods/names", "FA"},         {"Reference/method", "Q2"},
      {"Study/norms", "energy"},       {"Study/decisive error", "energy | reference"}};
  try
  {
    (void)parsed(settings);
    FAIL();
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what())
                  .find("energies of errors need a known solution; use the "
                        "target exact or local"),
              std::string::npos)
        << error.what();
  }
}
