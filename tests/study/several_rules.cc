// Several sampling rules in one study: each as it is alone, and what they need in comparison.

#include "tests/study/sampled_scenes.h"

#include "study/rule_comparison.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace sampled_scenes;

namespace
{
  using uq::SampleRule;

  const Settings both = {{"Sampling/rule", "Smolyak, Monte Carlo"},
                         {"Sampling/counts", "0, 1, 2; 4, 12"}};

  /// u = e^c x, whose quantity is e^c d.
  SamplingResults conclude_exponential(const Settings &settings)
  {
    Settings all = {{"Problem/solution", "exp(c)*x"}};
    all.insert(all.end(), settings.begin(), settings.end());
    const scene::Scene scene = random_scene(all);
    const SamplingPlan plan = make_sampling_plan(scene);
    return conclude_samples(scene, plan,
                            [&](std::size_t i)
                            {
                              Records made = exact_record(plan, i,
                                                          [](const std::vector<double> &values) {
                                                            return std::exp(values[0]) * values[1];
                                                          });
                              analysis::PointField &field = made[0].fields["u"];
                              for (std::size_t p = 0; p < field.points.size(); ++p)
                                field.values[p] = std::exp(plan.values[i][0]) * field.points[p][0];
                              return made;
                            });
  }

  void expect_same_bits(const SetStatistics &one, const SetStatistics &other)
  {
    EXPECT_EQ(one.rule, other.rule);
    EXPECT_EQ(one.count, other.count);
    EXPECT_EQ(one.n_samples, other.n_samples);
    EXPECT_EQ(one.noise, other.noise);
    EXPECT_EQ(one.mean_size, other.mean_size);
    EXPECT_EQ(one.deviation_size, other.deviation_size);
    EXPECT_EQ(one.mean_error, other.mean_error);
    EXPECT_EQ(one.deviation_error, other.deviation_error);
    EXPECT_EQ(one.standard_error, other.standard_error);
    EXPECT_EQ(one.interpolation_error, other.interpolation_error);
    const uq::Statistics &q = one.quantities.at("q"), &of_other = other.quantities.at("q");
    EXPECT_EQ(q.mean, of_other.mean);
    EXPECT_EQ(q.variance, of_other.variance);
    EXPECT_EQ(q.confidence, of_other.confidence);
  }

  /// Sets of n_samples samples each, of which errors are known.
  void add_sets(CaseStatistics &one, SampleRule rule,
                const std::vector<std::pair<std::size_t, double>> &sets)
  {
    for (const auto &[n_samples, error] : sets)
    {
      SetStatistics set;
      set.rule = rule;
      set.n_samples = n_samples;
      set.mean_size = 1;
      set.mean_error = error;
      one.sets.push_back(set);
    }
  }

  CaseStatistics finest_case()
  {
    CaseStatistics one;
    one.of.method = "OPT";
    one.of.series = "m = 3";
    one.of.h = .25;
    one.is_finest = true;
    return one;
  }
} // namespace

TEST(SeveralRules, TakeEachItsSamples)
{
  const SamplingPlan plan = make_sampling_plan(random_scene(both)),
                     alone = make_sampling_plan(random_scene(
                         {{"Sampling/rule", "Monte Carlo"}, {"Sampling/counts", "4, 12"}}));
  ASSERT_EQ(plan.sets.size(), 5u);
  const std::size_t n_sparse = plan.values.size() - 12;
  EXPECT_EQ(plan.sets[2].samples.size(), n_sparse);
  for (std::size_t s = 0; s < 5; ++s)
  {
    EXPECT_EQ(plan.sets[s].rule, s < 3 ? SampleRule::smolyak : SampleRule::monte_carlo);
    EXPECT_EQ(plan.last_like(s), s < 3 ? 2u : 4u);
  }
  EXPECT_EQ(plan.sets[3].samples,
            (std::vector<std::size_t>{n_sparse, n_sparse + 1, n_sparse + 2, n_sparse + 3}));
  for (std::size_t i = 0; i < 12; ++i)
    EXPECT_EQ(plan.values[n_sparse + i], alone.values[i]);
}

TEST(SeveralRules, ShareEqualPoints)
{
  const auto n_samples = [](const std::string &rule, const std::string &counts)
  {
    return make_sampling_plan(random_scene({{"Sampling/rule", rule}, {"Sampling/counts", counts}}))
        .values.size();
  };
  // three Gauss points each; the cross of level 1 is among their nine
  EXPECT_EQ(n_samples("tensor", "3"), 9u);
  EXPECT_EQ(n_samples("Smolyak", "1"), 5u);
  EXPECT_EQ(n_samples("tensor, Smolyak", "3; 1"), 9u);
  EXPECT_EQ(n_samples("tensor, Smolyak", "1"), 5u); // one list of counts for both
}

TEST(SeveralRules, HaveTheNumbersOfEachAloneToTheLastBit)
{
  for (const std::string variables : {"c: normal 0 0.2; d: uniform 2 4", // no interpolant
                                      "c: uniform -1 1; d: uniform 2 4"})
  {
    const Settings of_variables = {{"Random/variables", variables}};
    const auto with = [&](Settings settings)
    {
      settings.insert(settings.end(), of_variables.begin(), of_variables.end());
      return conclude_exponential(settings).cases.at(0);
    };
    const CaseStatistics together = with(both),
                         sparse =
                             with({{"Sampling/rule", "Smolyak"}, {"Sampling/counts", "0, 1, 2"}}),
                         drawn =
                             with({{"Sampling/rule", "Monte Carlo"}, {"Sampling/counts", "4, 12"}});
    ASSERT_EQ(together.sets.size(), 5u);
    for (std::size_t s = 0; s < 5; ++s)
      expect_same_bits(together.sets[s], s < 3 ? sparse.sets[s] : drawn.sets[s - 3]);
    EXPECT_EQ(together.samples, sparse.samples); // the first rule leads
    EXPECT_EQ(together.values, sparse.values);
    ASSERT_TRUE(together.field && sparse.field);
    EXPECT_EQ(together.field->deviation, sparse.field->deviation);
  }
}

TEST(SeveralRules, AreExpectedByName)
{
  const CaseStatistics one = conclude_exponential(both).cases.at(0);
  const auto known = [&](const std::string &name) { return study::sampled_quantity(one, name); };
  EXPECT_EQ(known("error of the mean"), one.sets[2].mean_error);
  EXPECT_EQ(known("error of the mean by Smolyak"), one.sets[2].mean_error);
  EXPECT_EQ(known("error of the mean by Monte Carlo"), one.sets[4].mean_error);
  EXPECT_EQ(known("mean of q by Monte Carlo"), one.sets[4].quantities.at("q").mean);
  EXPECT_FALSE(known("error of the mean by tensor"));
}

// The second rule is held against the last set of the first one at the finest level, not its own.
TEST(SeveralRules, WithoutATargetAreHeldAgainstTheLastSetOfTheFirst)
{
  Settings settings = both;
  settings.insert(settings.end(), {{"Problem/solution", ""},
                                   {"Problem/load", "1"},
                                   {"Problem/constraint", "0"},
                                   {"Study/norms", "averages L2"},
                                   {"Study/decisive error", "averages L2 | own finest level"}});
  const scene::Scene scene = random_scene(settings);
  const SamplingPlan plan = make_sampling_plan(scene);
  const auto records = [&](std::size_t i) -> Records
  {
    return {averages_record(0, [&](const auto &point)
                            { return point[0] * std::exp(plan.values[i][0]); })};
  };
  const CaseStatistics one = conclude_samples(scene, plan, records).cases.at(0);
  const double size = std::sqrt((.25 * .25 + .75 * .75) / 2); // of the field x
  const auto mean = [&](std::size_t set)
  {
    double sum = 0;
    for (std::size_t k = 0; k < plan.sets[set].samples.size(); ++k)
      sum += plan.sets[set].weights[k] * std::exp(plan.values[plan.sets[set].samples[k]][0]);
    return sum;
  };
  for (std::size_t s = 0; s < 5; ++s)
  {
    EXPECT_EQ(one.sets[s].is_target, s == 2);
    ASSERT_EQ(one.sets[s].mean_error.has_value(), s != 2);
    if (s != 2)
      EXPECT_NEAR(*one.sets[s].mean_error, std::abs(mean(s) - mean(2)) * size, 1e-14);
  }
}

TEST(SeveralRules, NeedSamplesForAnErrorThatAllReach)
{
  CaseStatistics one = finest_case();
  add_sets(one, SampleRule::smolyak, {{1, .5}, {5, .021}, {13, 1e-4}});
  add_sets(one, SampleRule::monte_carlo, {{4, .01}, {16, .1}, {64, .0219}, {256, .02}});
  const auto compared = study::compare_rules({one});
  ASSERT_EQ(compared.size(), 1u); // deviations have no errors
  EXPECT_EQ(compared[0].quantity, "mean");
  EXPECT_EQ(compared[0].error, .02);
  ASSERT_EQ(compared[0].needs.size(), 2u);
  EXPECT_EQ(compared[0].needs[0].rule, SampleRule::smolyak);
  EXPECT_EQ(compared[0].needs[0].n_samples, 5u);  // within a tenth
  EXPECT_EQ(compared[0].needs[1].n_samples, 64u); // four were good by chance
  EXPECT_EQ(words_of(compared[0]),
            "OPT, m = 3, h = 0.25: Smolyak needs the fewest samples for an error of the mean that "
            "all rules reach, 0.02 (Smolyak 5, Monte Carlo 64 samples)");

  one = finest_case();
  add_sets(one, SampleRule::monte_carlo, {{5, .01}});
  add_sets(one, SampleRule::tensor, {{1, 1}, {5, .009}});
  EXPECT_EQ(study::compare_rules({one}).at(0).error, .01); // of the first
  EXPECT_NE(words_of(study::compare_rules({one}).at(0))
                .find("Monte Carlo and tensor need the fewest samples"),
            std::string::npos);

  one.is_finest = false;
  EXPECT_TRUE(study::compare_rules({one}).empty());
  one = finest_case();
  add_sets(one, SampleRule::tensor, {{1, 1}, {5, .009}});
  EXPECT_TRUE(study::compare_rules({one}).empty());
}

// A thousand samples at random have a larger error than five points, which stay below the target.
TEST(SeveralRules, HaveACheapestPairEach)
{
  Settings settings = both;
  settings.insert(settings.end(), {{"Sampling/counts", "1, 2; 4, 1000"}});
  const SamplingResults results = conclude_exponential(settings);
  std::map<SampleRule, double> least; // target
  for (const study::CheapestPair &pair : results.cheapest)
    least[pair.rule] = pair.target;
  ASSERT_EQ(least.size(), 2u);
  EXPECT_LE(least[SampleRule::smolyak], 1e-3);
  EXPECT_GE(least[SampleRule::monte_carlo], 1e-3);
  ASSERT_EQ(results.balance.size(), 2u);
  EXPECT_NE(results.balance[0].rule, results.balance[1].rule);
}
