// Numbers of a scene that are random by their keys, and what is refused.

#include "base/error.h"
#include "scene/scene.h"

#include <gtest/gtest.h>

namespace
{
  using namespace plumbline;
  using Settings = std::vector<scene::Override>;

  /// A notched strip.
  scene::Scene strip(const Settings &settings)
  {
    Settings all = {{"Domain/boxes", "0, -0.5 : 3, 0.5"},
                    {"Kernel/type", "constant"},
                    {"Kernel/limit", "Navier"},
                    {"Material/model", "double well"},
                    {"Methods/names", "FA"},
                    {"Study/m", "4"},
                    {"Study/h", "0.025, 0.0125"},
                    {"Time/final time", "40"},
                    {"Crack/notch", "1"},
                    {"Random/variables", "a: normal; b: uniform"},
                    {"Sampling/rule", "tensor"},
                    {"Sampling/counts", "2"}};
    all.insert(all.end(), settings.begin(), settings.end());
    return scene::parse_scene("strip", "", all);
  }

  void expect_refused(const Settings &settings, const std::string &message)
  {
    try
    {
      (void)strip(settings);
      ADD_FAILURE() << "not refused: " << message;
    }
    catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos)
          << message << " is not in: " << error.what();
    }
  }
} // namespace

TEST(RandomKeys, AreReadAtMeansOrValues)
{
  const std::string keys = "Crack/load: 1 + 0.05*a; Time/damping: 2 + a*b";
  scene::Scene means = strip({{"Random/keys", keys}});
  EXPECT_EQ(means.crack.load, 1);
  EXPECT_EQ(means.time.damping, 2);
  const scene::Scene given = strip({{"Random/keys", keys}, {"Random/values", "2, -0.5"}});
  EXPECT_DOUBLE_EQ(given.crack.load, 1.1);
  EXPECT_EQ(given.time.damping, 1);

  means.study.series[0].levels.resize(1); // as commands may
  const scene::Scene sample = at_sample(means, {2, -.5}, 1),
                     next = at_sample(sample, {1. / 3, 0}, 1);
  EXPECT_DOUBLE_EQ(sample.crack.load, 1.1);
  EXPECT_EQ(sample.time.damping, 1);
  EXPECT_EQ(sample.name, "strip");
  EXPECT_EQ(sample.study.series[0].levels.size(), 1u);
  EXPECT_DOUBLE_EQ(next.crack.load, 1 + .05 / 3);
  EXPECT_DOUBLE_EQ(scene::parse_scene("again", sample.text).crack.load, 1.1);
}

TEST(RandomKeys, AreTheSameForAllOfAFieldsSamples)
{
  const scene::Scene body = scene::parse_scene("body", "",
                                               {{"Domain/boxes", "0, 0 : 1, 1"},
                                                {"Random/variables", "a: normal"},
                                                {"Random/field", "Gaussian"},
                                                {"Random/modes", "2"},
                                                {"Random/cell", "0.125"},
                                                {"Random/length", "0.5"},
                                                {"Sampling/rule", "tensor"},
                                                {"Sampling/counts", "2"},
                                                {"Problem/solution", "R + x*y"},
                                                {"Methods/names", "PA-AC"},
                                                {"Study/h", "0.25"},
                                                {"Random/keys", "Solver/tolerance: 1e-6*2^a"}});
  const scene::Scene sample = at_sample(body, {1, .5, 0}, 1);
  EXPECT_EQ(sample.random.source, body.random.source); // its modes are found once
  EXPECT_DOUBLE_EQ(sample.solver.tolerance, 2e-6);
  const scene::Scene plain =
      at_sample(scene::parse_scene("body", body.text, {{"Random/keys", ""}}), {1, .5, 0}, 1);
  EXPECT_EQ(sample.random.place({.3, .4}), plain.random.place({.3, .4}));
  EXPECT_NE(sample.random.place({.3, .4}), body.random.place({.3, .4}));
}

TEST(RandomKeys, AreRefusedWithTheRemedy)
{
  expect_refused({{"Random/keys", "Crack/load"}}, "write 'Section/key: expression'");
  expect_refused({{"Random/keys", "load: a"}}, "write 'Section/key: expression'");
  expect_refused({{"Random/keys", "Study/h: 0.1 + 0*a"}}, "the same for all samples");
  expect_refused({{"Random/keys", "Random/seed: 1"}}, "the same for all samples");
  expect_refused({{"Random/keys", "Crack/lod: a"}}, "Crack/load");
  expect_refused({{"Random/keys", "Crack/load: 1 + q"}}, "Random/keys: Crack/load");
  expect_refused({{"Random/keys", "Crack/load: 1 + x"}}, "use only constants and Random/variables");
  expect_refused({{"Random/keys", "Crack/load: 1/a"}}, "Crack/load"); // at its mean
  expect_refused({{"Random/keys", "Crack/load: 1 + a"}, {"Random/values", "1"}}, "1 numbers for 2");
  expect_refused({{"Random/keys", "Crack/notch: 1 + a/3"}, {"Random/values", "1, 0"}},
                 "give a multiple of h");
}
