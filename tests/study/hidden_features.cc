// Data with features between the points that an approximation looks at first: all methods must see
// them, or refuse.

#include "meshfree/method.h"
#include "physics/load.h"
#include "reference/method.h"
#include "study/comparison.h"
#include "study/preflight.h"

#include "base/error.h"
#include "scene/problem.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::study;

namespace
{
  using Settings = std::vector<scene::Override>;

  method::Methods all()
  {
    method::Methods methods = meshfree::methods();
    for (const auto &method : reference::methods())
      methods.push_back(method);
    return methods;
  }

  /// A load, u = 0 around.
  scene::Scene with_load(const std::string &load, const Settings &more = {})
  {
    Settings settings = {{"Problem/load", load},
                         {"Problem/constraint", "0"},
                         {"Problem/local solution", "none"},
                         {"Methods/names", "FA"},
                         {"Study/regime", "m"},
                         {"Study/horizon", "0.1"},
                         {"Study/h", "0.05"},
                         {"Study/norms", "averages L2"},
                         {"Study/decisive error", "averages L2 | own finest level"}};
    settings.insert(settings.end(), more.begin(), more.end());
    return scene::parse_scene("test.prm", "", settings);
  }

  std::vector<double> averages(const scene::Scene &scene, const std::string &method,
                               const problem::Level &level)
  {
    return analysis::solve(*find_method(all(), method, "test"), make_problem(scene, 0, level))
        .averages;
  }

  double largest(const std::vector<double> &values)
  {
    double result = 0;
    for (const double value : values)
      result = std::max(result, std::abs(value));
    return result;
  }

  /// |u_a + u_b - u_1| over |u_1| for loads that add up to 1.
  double defect(const std::string &a, const std::string &b, const std::string &method,
                const problem::Level &level, const Settings &more = {})
  {
    std::vector<double> sum = averages(with_load(a, more), method, level);
    const auto other = averages(with_load(b, more), method, level),
               one = averages(with_load("1", more), method, level);
    EXPECT_GT(largest(sum), .01 * largest(one)) << a << ' ' << method;
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] += other[i] - one[i];
    return largest(sum) / largest(one);
  }
} // namespace

TEST(HiddenFeatures, parts_of_a_load_yield_parts_of_the_solution)
{
  const std::vector<std::pair<std::string, std::string>> loads = {
      {"x > 0.51 ? (x < 0.66 ? 1 : 0) : 0", "x > 0.51 ? (x < 0.66 ? 0 : 1) : 1"},
      {"y > 0.34 ? (y < 0.45 ? 1 : 0) : 0", "y > 0.34 ? (y < 0.45 ? 0 : 1) : 1"},
      {"abs(x + y - 1.17) < 0.1", "abs(x + y - 1.17) >= 0.1"}};
  for (const auto &[a, b] : loads)
  {
    EXPECT_LT(defect(a, b, "FA", {.05, .1}), 1e-12) << a;
    EXPECT_LT(defect(a, b, "Q1", {.05, .1}), 1e-3) << a;
    EXPECT_LT(defect(a, b, "DGQ1", {.05, .1}), 1e-3) << a;
  }
  const Settings mesh = {{"Domain/mesh", "squares"}};
  EXPECT_LT(defect(loads[0].first, loads[0].second, "Q1", {.05, .1}, mesh), 1e-3);
  EXPECT_LT(defect(loads[0].first, loads[0].second, "FA", {.05, .1}, mesh), 1e-12);
}

TEST(HiddenFeatures, meshfree_and_galerkin_methods_agree_on_a_narrow_hat)
{
  const std::string hat = "max(0, 1 - abs(x-0.585)/0.08)*max(0, 1 - abs(y-0.585)/0.08)";
  const auto meshfree = averages(with_load(hat), "IPA-AC-R2", {.025, .1}),
             galerkin = averages(with_load(hat), "Q1", {.025, .1});
  ASSERT_EQ(meshfree.size(), galerkin.size());
  double difference = 0;
  for (std::size_t i = 0; i < meshfree.size(); ++i)
    difference = std::max(difference, std::abs(meshfree[i] - galerkin[i]));
  EXPECT_GT(largest(galerkin), 1e-3);
  EXPECT_LT(difference, .1 * largest(galerkin)); // nodes see some 6 places of the hat
}

// One of three fields that were solved as 0 by the points of their load.
TEST(HiddenFeatures, every_realisation_that_has_grains_has_a_solution)
{
  const scene::Scene scene = with_load("R", {{"Random/field", "ellipses"},
                                             {"Random/fraction", "0.0075"},
                                             {"Random/semi-axes", "0.06, 0.04"},
                                             {"Sampling/rule", "Monte Carlo"},
                                             {"Sampling/counts", "16"}});
  unsigned int n_seen = 0;
  for (unsigned int k = 1; k <= 12; ++k)
  {
    const scene::Scene one = at_sample(scene, {}, k);
    const problem::Problem<2> problem = make_problem(one, 0, {.02, .1});
    bool has_grains = false;
    for (const dealii::Point<2> &x : comparison_points(problem))
      has_grains = has_grains || one.names(.1).fields.at("R")(x) != 0;
    for (const char *method : {"IPA-AC-R2", "Q1"})
      EXPECT_EQ(largest(averages(one, method, {.02, .1})) > 0, has_grains) << k << ' ' << method;
    n_seen += has_grains ? 1 : 0;
  }
  EXPECT_GT(n_seen, 2u);
}

// The load of a bump narrower than the first points: as by many points in each ball.
TEST(HiddenFeatures, a_manufactured_load_is_that_of_its_narrow_bump)
{
  const std::string u = "1 + exp(-((x-0.5855)^2+(y-0.5855)^2)/0.0002)";
  const scene::Scene scene =
      scene::parse_scene("test.prm", "", {{"Problem/solution", u}, {"Methods/names", "FA"}});
  for (const problem::Level &level : {problem::Level{.05, .1}, problem::Level{.02, .06}})
  {
    const problem::Problem<2> problem = make_problem(scene, 0, level);
    const physics::ManufacturedLoad exact(problem.kernel, physics::Expression("u", u), {},
                                          [](const dealii::Point<2> &) { return 96u; });
    const double size = std::abs(exact({.5855, .5855}, 0));
    for (const dealii::Point<2> &x :
         {dealii::Point<2>(.5855, .5855), {.57, .6}, {.59, .54}, {.3, .5}, {.9, .7}})
      EXPECT_NEAR(problem.load(x, 0), exact(x, 0), 1e-10 * size) << x << ' ' << level.h;
  }
}

TEST(HiddenFeatures, a_manufactured_load_knows_a_narrow_inclusion)
{
  const std::string a = "1 + 3*exp(-((x-0.5855)^2+(y-0.45)^2)/0.0005)";
  const scene::Scene scene = scene::parse_scene("test.prm", "",
                                                {{"Problem/solution", "sin(3*x)*cos(2*y)"},
                                                 {"Domain/mesh", "squares"},
                                                 {"Kernel/coefficient", a},
                                                 {"Methods/names", "FA"}});
  const problem::Problem<2> problem = make_problem(scene, 0, {.125, .25});
  const physics::ManufacturedLoad exact(
      problem.kernel, physics::Expression("u", "sin(3*x)*cos(2*y)"),
      physics::Coefficient(physics::Expression("a", a), physics::Mean::arithmetic),
      [](const dealii::Point<2> &) { return 96u; });
  for (const dealii::Point<2> &x : {dealii::Point<2>(.5855, .45), {.6, .44}, {.5, .4}, {.1, .9}})
    EXPECT_NEAR(problem.load(x, 0), exact(x, 0), 1e-10 * std::abs(exact({.5855, .45}, 0))) << x;
}

TEST(HiddenFeatures, averages_of_a_narrow_solution_are_right)
{
  const auto mean_of = [](const std::string &u, const Settings &more)
  {
    Settings settings = {{"Problem/solution", u}, {"Problem/load", "1"}, {"Methods/names", "FA"}};
    settings.insert(settings.end(), more.begin(), more.end());
    const problem::Problem<2> problem =
        make_problem(scene::parse_scene("test.prm", "", settings), 0, {.1, .3});
    const auto means = cell_averages(*problem.solution, problem);
    double sum = 0;
    for (std::size_t i = 0; i < means.size(); ++i)
      sum += means[i] * cell_area(problem, i);
    return sum;
  };
  for (const Settings &more : {Settings{}, Settings{{"Domain/mesh", "squares"}}})
  {
    EXPECT_NEAR(mean_of("x > 0.523 ? (x < 0.651 ? 1 : 0) : 0", more), .128, 2e-4);
    EXPECT_NEAR(mean_of("(x-0.58)^2 + (y-0.42)^2 < 0.0049", more), M_PI * .0049, 1e-4);
    EXPECT_NEAR(mean_of("exp(-((x-0.585)^2+(y-0.585)^2)/0.0002)", more), M_PI * .0002, 1e-8);
  }
}
