// Which samples are taken: once each, in sequences that begin alike.

#include "tests/study/sampled_scenes.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace sampled_scenes;

TEST(SamplingPlan, TakesEachPointOnce)
{
  // the middle point of the odd rule is in all sets
  const scene::Scene scene = random_scene({{"Sampling/counts", "1, 3"}});
  const SamplingPlan plan = make_sampling_plan(scene);
  EXPECT_EQ(plan.values.size(), 9);
  ASSERT_EQ(plan.sets.size(), 2);
  EXPECT_EQ(plan.sets[0].samples.size(), 1);
  EXPECT_EQ(plan.values[plan.sets[0].samples[0]], (std::vector<double>{0, 3}));
  EXPECT_EQ(plan.sets[1].samples.size(), 9);
  EXPECT_NE(
      std::find(plan.sets[1].samples.begin(), plan.sets[1].samples.end(), plan.sets[0].samples[0]),
      plan.sets[1].samples.end());
  for (const double d : {plan.values[1][1], plan.values[5][1]})
    EXPECT_TRUE(d > 2 && d < 4);
}

TEST(SamplingPlan, SequencesBeginAlike)
{
  for (const char *const rule : {"Monte Carlo", "quasi-Monte Carlo"})
  {
    const SamplingPlan plan =
        make_sampling_plan(random_scene({{"Sampling/rule", rule}, {"Sampling/counts", "4, 10"}}));
    EXPECT_EQ(plan.values.size(), 10);
    EXPECT_EQ(plan.sets[0].samples, (std::vector<std::size_t>{0, 1, 2, 3}));
    EXPECT_EQ(plan.sets[0].weights, std::vector<double>(4, .25));
  }
}

TEST(SamplingPlan, ModesVaryFewToMany)
{
  const Settings field = {{"Random/field", "exponential"},
                          {"Random/cell", "0.25"},
                          {"Random/modes", "3"},
                          {"Sampling/modes", "1, 3"},
                          {"Random/variables", "d: uniform 2 4"},
                          {"Problem/solution", "x"},
                          {"Sampling/counts", "1, 2"}};
  const SamplingPlan plan = make_sampling_plan(random_scene(field));
  ASSERT_EQ(plan.sets.size(), 4);
  const std::vector<std::size_t> sizes = {1, 4, 1, 16};
  for (std::size_t s = 0; s < 4; ++s)
  {
    EXPECT_EQ(plan.sets[s].n_modes, s < 2 ? 1 : 3);
    EXPECT_EQ(plan.sets[s].count, s % 2 + 1);
    EXPECT_EQ(plan.sets[s].samples.size(), sizes[s]);
    for (const std::size_t i : plan.sets[s].samples)
    {
      ASSERT_EQ(plan.values[i].size(), 4);
      EXPECT_EQ(plan.values[i][2] != 0 && plan.values[i][3] != 0, s == 3);
    }
  }
  EXPECT_EQ(plan.sets[0].samples, plan.sets[2].samples); // all are 0: taken once
  EXPECT_EQ(plan.values.size(), 1 + 4 + 16);
  // sequences draw for each number of modes
  Settings drawn = field;
  drawn.insert(drawn.end(), {{"Sampling/rule", "Monte Carlo"}, {"Sampling/counts", "2, 5"}});
  const SamplingPlan sequence = make_sampling_plan(random_scene(drawn));
  EXPECT_EQ(sequence.values.size(), 10);
  EXPECT_EQ(sequence.sets[3].samples, (std::vector<std::size_t>{5, 6, 7, 8, 9}));
  for (const std::string bad : {"0, 1", "2, 1", "1, 4", "2, 2"})
  {
    Settings wrong = field;
    wrong.push_back({"Sampling/modes", bad});
    EXPECT_THROW(random_scene(wrong), InputError) << bad;
  }
}

TEST(SamplingPlan, ScenesTakeItsValues)
{
  const scene::Scene scene = random_scene({});
  const SamplingPlan plan = make_sampling_plan(scene);
  const scene::Scene at = plan.at(scene, 1);
  EXPECT_EQ(at.names(1).constants.at("c"), plan.values[1][0]);
  EXPECT_EQ(at.names(1).constants.at("d"), plan.values[1][1]);
  EXPECT_EQ(scene.names(1).constants.at("d"), 3); // its mean
}
