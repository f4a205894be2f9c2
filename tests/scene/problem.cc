// What a scene's words become: kernels, fields, coefficients of one level.
#include "scene/problem.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace plumbline;
using namespace plumbline::scene;

namespace
{
  Scene make_scene(std::vector<Override> settings)
  {
    settings.insert(settings.begin(), {"Methods/names", "Q1"});
    return parse_scene("test.prm", "", settings);
  }

  /// What is said about a scene that is refused; empty: it is not.
  std::string refusal(const std::vector<Override> &settings)
  {
    try
    {
      (void)make_scene(settings);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }

  const std::vector<Override> solid = {{"Problem/solution", "x, y"}, {"Kernel/type", "1/r"},
                                       {"Kernel/limit", "Navier"},   {"Material/model", "LPS"},
                                       {"Material/E", "1"},          {"Material/nu", "0.3"}};

  std::vector<Override> with(std::vector<Override> settings, const std::vector<Override> &more)
  {
    settings.insert(settings.end(), more.begin(), more.end());
    return settings;
  }
} // namespace

TEST(SceneKernel, has_the_limit_that_is_asked_for)
{
  for (const auto &[limit, diffusion] : {std::pair{"-Laplace", 1.}, {"-1/2 Laplace", .5}})
  {
    const Scene scene = make_scene({{"Problem/solution", "x"}, {"Kernel/limit", limit}});
    EXPECT_NEAR(make_kernel(scene, .4).limit().diffusion, diffusion, 1e-14) << limit;
  }
}

TEST(MakeProblem, knows_the_horizon_by_its_name)
{
  const Scene scene = make_scene({{"Problem/load", "delta*x"},
                                  {"Problem/constraint", "delta"},
                                  {"Problem/local solution", "none"},
                                  {"Reference/method", "Q2"},
                                  {"Study/norms", "averages L2"},
                                  {"Study/decisive error", "averages L2 | reference"}});
  const Problem problem = make_problem(scene, 0, {.125, .375});
  EXPECT_NEAR(problem.load.value({.5, .5}, 0), .375 * .5, 1e-15);
  EXPECT_NEAR(problem.constraint.value({-.1, .5}, 0), .375, 1e-15);
}

TEST(MakeProblem, takes_the_mean_of_coefficients_that_is_asked_for)
{
  for (const auto &[symmetrisation, mean] : {std::pair{"arithmetic", 2.5}, {"harmonic", 1.6}})
  {
    const Scene scene = make_scene({{"Problem/solution", "x"},
                                    {"Domain/mesh", "squares"},
                                    {"Kernel/coefficient", "x < 0.5 ? 1 : 4"},
                                    {"Kernel/symmetrisation", symmetrisation}});
    const Problem problem = make_problem(scene, 0, {.25, .5});
    ASSERT_TRUE(problem.coefficient);
    const double left = problem.coefficient->at({.2, .5}),
                 right = problem.coefficient->at({.8, .5});
    EXPECT_NEAR(problem.coefficient->mean(left, right), mean, 1e-14) << symmetrisation;
  }
}

// Of quadratics the nonlocal operator is the local one, -[μ Δu + (λ + μ) ∇ div u]: moments of the
// influence function above the second do not count. Bonds alone yield it with λ = μ.
TEST(MakeProblem, makes_the_load_of_a_solid_from_its_bonds_and_its_dilatation)
{
  constexpr double E = 1, nu = .3, tolerance = 1e-10; // of the quadrature, relative
  const double lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
  const Scene scene = make_scene(with(
      solid, {{"Material/plane", "strain"}, {"Problem/solution", "x^2 + 2*y^2, 3*x*y + y^2"}}));
  const Problem problem = make_problem(scene, 0, {.125, .25});
  ASSERT_TRUE(problem.dilatation);
  for (const dealii::Point<2> &x : {dealii::Point<2>(.4, .7), {.05, .1}})
  {
    const double along_x = -(6 * mu + 5 * (lambda + mu)), along_y = -(2 * mu + 2 * (lambda + mu));
    EXPECT_NEAR(problem.load.value(x, 0) / along_x, 1, tolerance);
    EXPECT_NEAR(problem.load.value(x, 1) / along_y, 1, tolerance);
  }
}

// A series of a layer would need 129² balls of 1e5 points, a minute and more.
TEST(MakeProblem, looks_for_no_series_of_a_load_whose_field_has_none)
{
  for (const bool is_sharp : {false, true})
  {
    const std::string u = is_sharp ? "atan(20*(x-.43))*cos(y)" : "atan(2*(x-.43))*cos(y)";
    const Scene scene = make_scene({{"Problem/solution", u}, {"Kernel/type", "1/r"}});
    const Problem problem = make_problem(scene, 0, {.1, .3});
    EXPECT_EQ(problem.load.series.has_value(), !is_sharp);
    const dealii::Point<2> x(.44, .3);
    EXPECT_NEAR(problem.load(x, 0), problem.load.value(x, 0),
                1e-11 * std::abs(problem.load.value(x, 0)));
  }
}

TEST(SceneErrors, a_collar_must_be_as_wide_as_the_operator_reaches)
{
  const std::vector<Override> sizes = {{"Study/m", "2"}, {"Study/h", "0.125"}};
  const auto collar = [&](const std::string &width) {
    return std::vector<Override>{{"Domain/collar", width}};
  };
  // dilatations reach two horizons, bonds one
  EXPECT_EQ(refusal(with(with(solid, sizes), collar("0.5"))), "");
  const std::string thin = refusal(with(with(solid, sizes), collar("0.375")));
  EXPECT_NE(thin.find("thinner than twice the horizon"), std::string::npos) << thin;
  const std::vector<Override> bonds = with({{"Problem/solution", "x"}}, sizes);
  EXPECT_EQ(refusal(with(bonds, collar("0.25"))), "");
  EXPECT_NE(refusal(with(bonds, collar("0.2"))).find("thinner than the horizon"),
            std::string::npos);
}

TEST(SceneErrors, a_number_has_no_tail)
{
  const std::string message = refusal({{"Problem/solution", "x"}, {"Study/h", "0.1, 0.05m"}});
  EXPECT_NE(message.find("is not allowed, for '0.05m' in it"), std::string::npos) << message;
}

TEST(SceneErrors, a_reference_is_compared_by_cell_averages)
{
  const auto decided_by = [](const std::string &error)
  {
    return refusal({{"Problem/solution", "x"},
                    {"Reference/method", "Q2"},
                    {"Study/norms", "nodal Linf, averages L2"},
                    {"Study/decisive error", error}});
  };
  EXPECT_EQ(decided_by("averages L2 | reference"), "");
  const std::string message = decided_by("nodal Linf | reference");
  EXPECT_NE(message.find("by cell averages"), std::string::npos) << message;
}

TEST(SceneErrors, a_solid_that_can_crack_keeps_its_dilatation)
{
  const std::vector<Override> bond_based =
      with(solid, {{"Material/nu", "0.25"}, {"Domain/mesh", "squares"}, {"Methods/names", "FA"}});
  EXPECT_FALSE(make_scene(bond_based).has_dilatation());
  EXPECT_TRUE(
      make_scene(with(bond_based, {{"Domain/cracks", "0.5, 0.5 : 0.7, 0.5"}})).has_dilatation());
}
