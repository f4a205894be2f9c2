// What is said of samples: negative variances, what modes hold, and what is not as expected.

#include "tests/study/sampled_scenes.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace sampled_scenes;

TEST(SampleStatistics, NegativeVariancesAreSaidAndHaveNoDeviation)
{
  std::string variables;
  for (int i = 0; i < 20; ++i)
    variables += "c" + std::to_string(i) + ": normal; ";
  const scene::Scene scene = random_scene({{"Random/variables", variables},
                                           {"Problem/solution", "(1 + c0)*x"},
                                           {"Sampling/rule", "Smolyak"},
                                           {"Sampling/counts", "1"}});
  const SamplingPlan plan = make_sampling_plan(scene);
  EXPECT_EQ(plan.values.size(), 41);
  const SamplingResults results = conclude(scene, plan,
                                           [](const std::vector<double> &values)
                                           {
                                             double sum = 0;
                                             for (const double one : values)
                                               sum += one * one;
                                             return sum;
                                           });
  const uq::Statistics &found = results.cases[0].sets[0].quantities.at("q");
  EXPECT_NEAR(found.variance, -340, 1e-9);
  EXPECT_FALSE(found.deviation());
  ASSERT_EQ(results.findings.size(), 2);
  EXPECT_NE(results.findings[0].find("-340"), std::string::npos) << results.findings[0];
  // which is the mean of a sum, all the same
  EXPECT_NE(results.findings[1].find("mean of q is 20, and samples are between 0 and 3"),
            std::string::npos)
      << results.findings[1];
  EXPECT_FALSE(sampled_quantity(results.cases[0], "deviation of q"));
  EXPECT_NEAR(*sampled_quantity(results.cases[0], "variance of q"), -340, 1e-9);
}

// Σ c_i² of twenty variables: at level 1 its variance is -340, at level 2 it is 40, which is exact.
TEST(SampleStatistics, NegativeVariancesOfFieldsHaveNoDeviationAndNoErrorOfIt)
{
  std::string variables;
  for (int i = 0; i < 20; ++i)
    variables += "c" + std::to_string(i) + ": normal; ";
  const auto conclude_counts = [&](const std::string &counts)
  {
    const scene::Scene scene =
        random_scene({{"Random/variables", variables},
                      {"Sampling/rule", "Smolyak"},
                      {"Sampling/counts", counts},
                      {"Problem/solution", ""},
                      {"Problem/load", "1"},
                      {"Problem/constraint", "0"},
                      {"Study/h", "0.5, 0.25"},
                      {"Study/norms", "averages L2"},
                      {"Study/decisive error", "averages L2 | own finest level"}});
    const SamplingPlan plan = make_sampling_plan(scene);
    const auto record_of = [&](std::size_t sample)
    {
      double sum = 0;
      for (const double one : plan.values[sample])
        sum += one * one;
      const auto value = [&](const auto &point)
      { return point[0] < .5 ? sum : 3; }; // constant on the right
      return Records{averages_record(0, value), averages_record(1, value)};
    };
    return conclude_samples(scene, plan, record_of);
  };
  const SamplingResults results = conclude_counts("1, 2");
  for (const CaseStatistics &one : results.cases)
  {
    EXPECT_NEAR(one.sets[0].negative_part, .5, 1e-15);
    EXPECT_FALSE(one.sets[0].deviation_size);
    EXPECT_FALSE(one.sets[0].deviation_error);
    EXPECT_LT(*one.sets[0].mean_error, 1e-10); // exact for squares
    EXPECT_EQ(one.sets[1].negative_part, 0);
    EXPECT_NEAR(*one.sets[1].deviation_size, std::sqrt(.5 * 40), 1e-9);
  }
  EXPECT_LT(*results.cases[0].sets[1].deviation_error, 1e-9);
  const auto n_said = [](const SamplingResults &of, const std::string &what)
  {
    return std::count_if(of.findings.begin(), of.findings.end(),
                         [&](const std::string &one) { return one.find(what) != one.npos; });
  };
  const std::string what = "the variance of the field is negative in 50 % of the domain";
  EXPECT_EQ(n_said(results, what), 2);
  EXPECT_FALSE(sampled_quantity(conclude_counts("1").cases[1], "size of the deviation"));
  // one sample has a deviation, 0, but what it is held against has none
  const SamplingResults without = conclude_counts("0, 1");
  for (const CaseStatistics &one : without.cases)
  {
    EXPECT_EQ(*one.sets[0].deviation_size, 0);
    EXPECT_FALSE(one.sets[0].deviation_error);
    EXPECT_NEAR(*one.sets[0].mean_error, 20 * std::sqrt(.5), 1e-10);
  }
  EXPECT_EQ(n_said(without, "those of other sets are held against nothing"), 1);
}

// Of exp(-|x-y|/l) in x and y, l = .2: the first eigenvalue in one dimension is .3309, the second
// .2098.
TEST(SampleStatistics, OfModesSayWhatVarianceTheyHold)
{
  const Settings field = {{"Random/field", "separable exponential"},
                          {"Random/length", "0.2"},
                          {"Random/cell", "0.01"},
                          {"Random/deviation", "3"},
                          {"Sampling/counts", "1"}};
  const auto with_modes = [&](const std::string &n)
  {
    Settings settings = field;
    settings.push_back({"Random/modes", n});
    const scene::Scene scene = random_scene(settings);
    return conclude(scene, make_sampling_plan(scene), first);
  };
  const SamplingResults few = with_modes("3");
  ASSERT_TRUE(few.spectrum);
  EXPECT_EQ(few.variables, (std::vector<std::string>{"c", "d", "mode 1", "mode 2", "mode 3"}));
  const double kept = .3309206 * (.3309206 + 2 * .2097761);
  EXPECT_NEAR(few.spectrum->variance_kept(), kept, 1e-3);
  EXPECT_NEAR(few.spectrum->deviation, 3 * std::sqrt(kept), 5e-3);
  ASSERT_EQ(few.findings.size(), 1);
  EXPECT_NE(few.findings[0].find(words_of(*few.spectrum)), std::string::npos) << few.findings[0];
  const auto faults = [&](const std::string &expected)
  {
    return sampling_faults(few, random_scene({{"Expected/sampling", expected},
                                              {"Expected/error tolerance", "0.01"}})
                                    .expected)
        .size();
  };
  EXPECT_EQ(faults("PA-AC, variance kept: 0.248"), 0);
  EXPECT_EQ(faults("PA-AC, variance kept: 0.26"), 1);
  EXPECT_TRUE(with_modes("20").findings.empty());
  EXPECT_FALSE(conclude(random_scene({}), make_sampling_plan(random_scene({})), first).spectrum);
}

TEST(SampleStatistics, ExpectationsAreOfTheLargestSet)
{
  const scene::Scene scene = random_scene({});
  const SamplingPlan plan = make_sampling_plan(scene);
  const SamplingResults results = conclude(scene, plan, first);
  const auto faults = [&](const std::string &expected)
  {
    return sampling_faults(results, random_scene({{"Expected/sampling", expected}}).expected)
        .size();
  };
  EXPECT_EQ(faults("PA-AC, deviation of q: 0.2; PA-AC, samples: 4"), 0);
  EXPECT_EQ(faults("PA-AC, deviation of q: 0.21"), 1);
  EXPECT_EQ(faults("PA-AC, samples: 1"), 1);
  EXPECT_EQ(faults("FA, samples: 4"), 1);
  EXPECT_EQ(faults("PA-AC, mean of p: 4"), 1);
}
