// What is random in a scene: variables and fields in its expressions, and what is refused.

#include "base/error.h"
#include "scene/problem.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace plumbline;
  using dealii::Point;

  using Settings = std::vector<scene::Override>;

  scene::Scene random_scene(const Settings &settings)
  {
    Settings all = {{"Domain/boxes", "0, 0 : 2, 1"},
                    {"Domain/mesh", "squares"},
                    {"Random/variables", "c: normal 1 0.2; d: uniform 2 4"},
                    {"Problem/solution", "c*x + d*y"},
                    {"Methods/names", "PA-AC"},
                    {"Study/h", "0.25"},
                    {"Sampling/rule", "tensor"},
                    {"Sampling/counts", "2"}};
    all.insert(all.end(), settings.begin(), settings.end());
    return scene::parse_scene("random", "", all);
  }

  void expect_refused(const Settings &settings, const std::string &message)
  {
    try
    {
      (void)random_scene(settings);
      ADD_FAILURE() << "not refused: " << message;
    }
    catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos)
          << error.what() << "\nhas not: " << message;
    }
  }

  /// A solid whose modulus follows a field.
  Settings solid(const Settings &settings)
  {
    Settings all = {{"Kernel/type", "1/r"},          {"Kernel/limit", "Navier"},
                    {"Material/model", "LPS"},       {"Material/E", "2 + c + R"},
                    {"Material/nu", "0.25"},         {"Problem/solution", "x, y"},
                    {"Random/field", "ellipses"},    {"Random/semi-axes", "0.1, 0.06"},
                    {"Sampling/rule", "Monte Carlo"}};
    all.insert(all.end(), settings.begin(), settings.end());
    return all;
  }

  double modulus(const scene::Scene &scene, const Point<2> &x)
  {
    return 2.5 * scene.material.lame()(x).mu; // E at nu = 1/4
  }
} // namespace

TEST(RandomScene, IsTakenAtMeansOrValues)
{
  const scene::Scene means = random_scene({}),
                     given = random_scene({{"Random/values", "0.5, 2.5"}});
  const Point<2> x(.25, .5);
  const auto u = [&](const scene::Scene &scene)
  { return make_problem(scene, 0, scene.study.series[0].levels[0]).solution->value(x, 0); };
  EXPECT_DOUBLE_EQ(u(means), 1 * .25 + 3 * .5);
  EXPECT_DOUBLE_EQ(u(given), .5 * .25 + 2.5 * .5);
  EXPECT_DOUBLE_EQ(u(at_sample(means, {.5, 2.5}, 1)), .5 * .25 + 2.5 * .5);
}

TEST(RandomScene, EllipsesAreZeroAndOneAndOfTheirRealisation)
{
  const scene::Scene scene = random_scene(solid({{"Random/fraction", "0.5"}}));
  const scene::Scene same = at_sample(scene, {}, 1), other = at_sample(scene, {}, 2);
  unsigned int n_in = 0, n_differ = 0;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 20; ++j)
    {
      const Point<2> x(.05 * i, .05 * j);
      const double R = modulus(scene, x) - 3;
      EXPECT_NEAR(R * (1 - R), 0, 1e-13);
      EXPECT_EQ(modulus(same, x), modulus(scene, x));
      n_in += R > .5;
      n_differ += std::abs(modulus(other, x) - modulus(scene, x)) > .5;
    }
  EXPECT_NEAR(n_in / 800., .5, .2);
  EXPECT_GT(n_differ, 200u);
  EXPECT_FALSE(scene.material.is_homogeneous);
  // beyond the box it is as at the nearest point
  EXPECT_EQ(modulus(scene, {-1, .3}), modulus(scene, {0, .3}));
  EXPECT_EQ(modulus(random_scene(solid({{"Random/fraction", "1"}})), {.3, .3}), 4);
  EXPECT_EQ(modulus(random_scene(solid({{"Random/fraction", "0"}})), {.3, .3}), 3);
}

TEST(RandomScene, FieldsOfModesAreLinearInThem)
{
  const Settings field = solid({{"Random/field", "Gaussian"},
                                {"Random/modes", "3"},
                                {"Random/cell", "0.1"},
                                {"Random/length", "0.5"},
                                {"Random/mean", "0.7"},
                                {"Random/deviation", "0.3"}});
  const scene::Scene mean = random_scene(field);
  const Point<2> x(.31, .77);
  EXPECT_NEAR(modulus(mean, x), 3.7, 1e-13);
  const auto R = [&](const std::vector<double> &modes)
  {
    std::vector<double> values = {1, 3};
    values.insert(values.end(), modes.begin(), modes.end());
    return modulus(at_sample(mean, values, 1), x) - 3;
  };
  const double first = R({1, 0, 0}) - .7, third = R({0, 0, 1}) - .7;
  EXPECT_GT(std::abs(first), .01);
  EXPECT_NEAR(R({2, 0, -3}), .7 + 2 * first - 3 * third, 1e-13);
  // three modes hold less than all of the variance
  const random::Expansion &expansion = *mean.random.source->expansion();
  EXPECT_LT(expansion.variance_kept(), 1);
  EXPECT_GT(expansion.variance_kept(), .5);
  EXPECT_NEAR(expansion.total_variance(), .09 * 2, 1e-12);
}

TEST(RandomScene, FieldsFillTheBoxThatIsGiven)
{
  const auto field = [](const std::string &mesh, const std::string &box)
  {
    return solid({{"Domain/arguments", mesh == "squares" ? "" : "-3 : 3 : false"},
                  {"Domain/inside", mesh == "squares" ? "" : "1 - x^2 - y^2"},
                  {"Random/field", "exponential"},
                  {"Random/modes", "3"},
                  {"Random/cell", "0.25"},
                  {"Random/deviation", "0.3"},
                  {"Random/box", box},
                  {"Domain/mesh", mesh}});
  };
  const scene::Scene ball = random_scene(field("hyper_cube", "-1.5, -1 : 1.5, 1"));
  const random::Expansion &expansion = *ball.random.source->expansion();
  EXPECT_NEAR(expansion.total_variance(), .09 * 6, 1e-12);
  const scene::Scene at = at_sample(ball, {1, 3, 1, 1, 1}, 1);
  EXPECT_GT(std::abs(modulus(at, {-1.4, -.9}) - modulus(at, {-.5, -.5})), .001);
  EXPECT_EQ(modulus(at, {-1.6, -.9}), modulus(at, {-1.5, -.9}));
  expect_refused(field("hyper_cube", ""), "not known before the mesh is made; give Random/box");
  expect_refused(field("squares", "0, 0 : 1, 1; 1, 1 : 2, 2"), "2 boxes; give one");
}

TEST(RandomScene, PrincipalComponentsOfEllipsesAreNearlyGrey)
{
  const scene::Scene scene = random_scene(solid({{"Random/fraction", "0.4"},
                                                 {"Random/modes", "4"},
                                                 {"Random/cell", "0.05"},
                                                 {"Random/realisations", "200"}}));
  const random::Expansion &expansion = *scene.random.source->expansion();
  double mean = 0;
  for (const double one : expansion.mean)
    mean += one / static_cast<double>(expansion.mean.size());
  EXPECT_NEAR(mean, .4, .02);
  EXPECT_LT(expansion.variance_kept(), .2);
  const scene::Scene at = at_sample(scene, {1, 3, 1, -1, 1, 1}, 1);
  for (const Point<2> x : {Point<2>(.5, .5), Point<2>(1.2, .3)})
    EXPECT_NEAR(modulus(at, x) - 3, .4, .35); // neither 0 nor 1
}

TEST(RandomScene, IsRefusedWithTheRemedy)
{
  expect_refused({{"Sampling/counts", ""}}, "needs Sampling/counts");
  expect_refused({{"Sampling/counts", "3, 2"}}, "must rise");
  expect_refused({{"Sampling/counts", "2, 0.5"}}, "'0.5' is no count");
  expect_refused({{"Sampling/counts", "0, 2"}}, "is no sample");
  expect_refused({{"Sampling/counts", "1001"}}, "1.002e+06 samples, more than");
  expect_refused({{"Random/variables", ""}}, "unknown name");
  expect_refused({{"Random/variables", ""}, {"Problem/solution", "x"}}, "needs variables");
  expect_refused({{"Random/variables", "c: normal 0 0"}}, "a deviation must be positive");
  expect_refused({{"Random/variables", "c: uniform 2 1"}}, "must be below");
  expect_refused({{"Random/variables", "c: normal; x: normal"}}, "'x' means something already");
  expect_refused({{"Random/variables", "c: normal; c: normal"}}, "'c' means something already");
  expect_refused({{"Random/variables", "c: gamma"}}, "write 'name: normal");
  expect_refused({{"Random/variables", "c: normal 1"}}, "write 'name: normal");
  expect_refused({{"Random/variables", "c"}}, "has no ':'");
  expect_refused({{"Random/variables", "2c: normal"}}, "is no name");
  expect_refused({{"Random/values", "1"}}, "1 numbers for 2 variables");
  expect_refused({{"Random/modes", "3"}}, "needs a field");
  expect_refused(
      {{"Sampling/rule", "Smolyak"}, {"Sampling/growth", "nested"}, {"Sampling/counts", "5"}},
      "of normal variables there are levels 0 to 4");
  expect_refused(solid({{"Random/field", "exponential"}}), "needs Random/modes");
  expect_refused(solid({{"Random/field", "Matern"}, {"Random/modes", "4"}}), "Random/cell > 0");
  const auto matern = [](const std::string &key, const std::string &value)
  {
    return solid({{"Random/field", "Matern"},
                  {"Random/modes", "4"},
                  {"Random/cell", "0.5"},
                  {"Random/" + key, value}});
  };
  expect_refused(matern("modes", "9"), "8 cells, which have no more modes");
  expect_refused(matern("length", "0"), "length");
  expect_refused(matern("smoothness", "-1"), "smoothness");
  expect_refused(matern("length", "1, 2, 3"), "one number, or two");
  expect_refused(solid({{"Random/semi-axes", "1, -1"}}), "semi-ax");
  // realisations are no values of variables
  for (const char *const rule : {"tensor", "Smolyak", "quasi-Monte Carlo"})
    expect_refused(solid({{"Sampling/rule", rule}}), "is drawn as a whole");
  expect_refused(solid({{"Random/fraction", "1"}, {"Random/modes", "2"}, {"Random/cell", "0.1"}}),
                 "is the same everywhere");
}
