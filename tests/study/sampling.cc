// Statistics over samples: sets that share them, samples that failed, exact fields.

#include "tests/study/sampled_scenes.h"

#include "base/error.h"
#include "study/exact_statistics.h"
#include "tests/text_folder.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace sampled_scenes;

TEST(SampleStatistics, OfGrowthSayWhichSchemeTheyAreOf)
{
  for (const bool has_surface_terms : {false, true})
  {
    scene::Scene scene;
    scene.fracture.toughness = "1";
    scene.fracture.surface_terms =
        has_surface_terms ? problem::SurfaceTerms::published : problem::SurfaceTerms::uncorrected;
    const auto said = [&]
    {
      const auto findings =
          study::conclude_samples(scene, SamplingPlan{}, [](std::size_t) { return std::nullopt; })
              .findings;
      return std::count_if(findings.begin(), findings.end(),
                           [&](const std::string &one) {
                             return one.find(has_surface_terms ? "grow with surface"
                                                               : "grow without surface") == 7;
                           });
    };
    EXPECT_EQ(said(), 1);
    scene.sampling.analysis = scene::SampledAnalysis::stability;
    EXPECT_EQ(said(), 0);
  }
}

TEST(SampleStatistics, OfExactFieldsHaveNoErrorButTheRules)
{
  const scene::Scene scene = random_scene({});
  const SamplingPlan plan = make_sampling_plan(scene);
  const SamplingResults results = conclude(scene, plan, first);
  ASSERT_EQ(results.cases.size(), 1);
  EXPECT_TRUE(results.is_complete);
  const SetStatistics &one = results.cases[0].sets[0], &two = results.cases[0].sets[1];
  ASSERT_TRUE(one.mean_error && two.deviation_error);
  EXPECT_LT(*one.mean_error, 1e-14);
  EXPECT_LT(*two.mean_error, 1e-14);
  // of a linear field two points have the deviation, one has none
  const double size = std::sqrt(.25 * (.01 + .16 + .36 + .81));
  EXPECT_LT(*two.deviation_error, 1e-8); // √ of rounding
  EXPECT_NEAR(*one.deviation_error, .2 * size, 1e-8);
  EXPECT_NEAR(two.mean_size, size, 1e-14);
  EXPECT_NEAR(*two.deviation_size, .2 * size, 1e-14);
  EXPECT_EQ(two.seconds, 4);
  EXPECT_NEAR(two.quantities.at("q").mean, 0, 1e-15);
  EXPECT_NEAR(*two.quantities.at("q").deviation(), .2, 1e-14);
  ASSERT_TRUE(results.cases[0].field);
  EXPECT_NEAR(results.cases[0].field->deviation[3], .2 * .9, 1e-14);
  // the cheapest set that reaches all targets is the one of one sample
  ASSERT_FALSE(results.cheapest.empty());
  EXPECT_EQ(results.cheapest.back().count, 1);
  EXPECT_EQ(results.cheapest.back().seconds, 1);
}

TEST(SampleStatistics, ThatWereMovedShowIt)
{
  const scene::Scene scene = random_scene({});
  const SamplingPlan plan = make_sampling_plan(scene);
  const SamplingResults results =
      conclude_samples(scene, plan,
                       [&](std::size_t i)
                       {
                         Records record = exact_record(plan, i, first);
                         for (double &value : record[0].fields["u"].values)
                           value += .02;
                         return record;
                       });
  EXPECT_NEAR(*results.cases[0].sets[1].mean_error, .02, 1e-14);
  EXPECT_NEAR(*results.cases[0].sets[1].deviation_error, 0, 1e-8);
  EXPECT_EQ(results.cheapest.size(), 1); // 1e-1
  ASSERT_EQ(results.balance.size(), 1);  // one point has the mean of what is linear
  EXPECT_EQ(results.balance[0].enough.value_or(0), 1);
  EXPECT_NEAR(results.balance[0].error, .02, 1e-14);
}

// At h = 1/4 errors of mesh and of two samples cancel; at h = 1/8 they do not.
TEST(SampleStatistics, CheapestPairStaysBelowItsTarget)
{
  const scene::Scene scene = random_scene({{"Study/h", "0.25, 0.125"}});
  const SamplingPlan plan = make_sampling_plan(scene);
  const auto cheapest = [&](double error_of_fine, double seconds_of_fine)
  {
    return conclude_samples(scene, plan,
                            [&](std::size_t i)
                            {
                              Records record = exact_record(plan, i, first);
                              record.push_back(record[0]);
                              Record &fine = record[1];
                              fine.key.level = 1;
                              fine.key.h = .125;
                              fine.cost.solve_seconds = seconds_of_fine;
                              for (double &value : fine.fields["u"].values)
                                value += error_of_fine;
                              return record;
                            })
        .cheapest;
  };
  EXPECT_EQ(cheapest(.5, 4).size(), 0); // the coarse level's 0 is chance
  const auto pairs = cheapest(.02, 4);
  ASSERT_EQ(pairs.size(), 1);
  EXPECT_EQ(pairs[0].h, .25);
  EXPECT_EQ(pairs[0].count, 1);
  EXPECT_EQ(cheapest(.02, 1.1)[0].h, .25); // a tie: the larger h
  EXPECT_EQ(cheapest(.02, .5)[0].h, .125);
}

TEST(SampleStatistics, ThatAnAxisIsNoChanceAdviseNothing)
{
  const auto conclude = [](const std::string &rule)
  {
    const scene::Scene scene =
        random_scene({{"Random/variables", "c: uniform 0 0.2"}, {"Sampling/rule", rule}});
    const SamplingPlan plan = make_sampling_plan(scene);
    return conclude_samples(scene, plan,
                            [&](std::size_t i)
                            {
                              Records record = exact_record(plan, i, first);
                              for (double &value : record[0].fields["u"].values)
                                value += .02;
                              return record;
                            });
  };
  EXPECT_FALSE(conclude("tensor").cheapest.empty());
  EXPECT_FALSE(conclude("tensor").balance.empty());
  EXPECT_TRUE(conclude("equidistant").cheapest.empty());
  EXPECT_TRUE(conclude("equidistant").balance.empty());
}

// A field of which each of three modes adds its part, at two levels whose errors are known.
TEST(SampleStatistics, WithoutATargetAreHeldAgainstTheLastSetOfTheFinestLevel)
{
  const scene::Scene scene =
      random_scene({{"Random/variables", ""},
                    {"Random/field", "exponential"},
                    {"Random/cell", "0.25"},
                    {"Random/modes", "3"},
                    {"Sampling/modes", "1, 2, 3"},
                    {"Sampling/counts", "1, 2"},
                    {"Problem/solution", ""},
                    {"Problem/load", "1"},
                    {"Problem/constraint", "0"},
                    {"Study/h", "0.5, 0.25"},
                    {"Study/norms", "averages L2"},
                    {"Study/decisive error", "averages L2 | own finest level"}});
  const SamplingPlan plan = make_sampling_plan(scene);
  constexpr double of_h = 2e-3;
  const std::array<double, 3> part = {.5, .05, -.05};
  const SamplingResults results = conclude_samples(
      scene, plan,
      [&](std::size_t sample)
      {
        Records records;
        for (const unsigned int level : {0u, 1u})
        {
          records.push_back(averages_record(level,
                                            [&](const auto &point)
                                            {
                                              double value = point[0] + (level == 0 ? of_h : 0);
                                              for (std::size_t d = 0; d < 3; ++d)
                                                value += part[d] * plan.values[sample][d] *
                                                         plan.values[sample][d];
                                              return value;
                                            }));
          records.back().cost.solve_seconds = level == 0 ? 1 : .5;
        }
        return records;
      });
  // one point sees no square, two see all of it: E ξ² = 1
  ASSERT_EQ(results.cases.size(), 2);
  const double all = .5;
  for (std::size_t level = 0; level < 2; ++level)
    for (std::size_t s = 0; s < 6; ++s)
    {
      const SetStatistics &set = results.cases[level].sets[s];
      double error = all - (level == 0 ? of_h : 0);
      for (std::size_t d = 0; d <= s / 2 && s % 2 == 1; ++d)
        error -= part[d];
      EXPECT_EQ(set.is_target, level == 1 && s == 5);
      EXPECT_EQ(results.cases[level].is_target_level, level == 1);
      EXPECT_EQ(set.mean_error.has_value(), !set.is_target);
      if (set.mean_error)
      {
        EXPECT_NEAR(*set.mean_error, std::abs(error), 1e-13) << level << ' ' << s;
      }
    }
  // one mode leaves nothing by chance, two .05, three what the mesh does, .002; the finest level
  // is less dear, but its errors are not the mesh's
  ASSERT_EQ(results.cheapest.size(), 2);
  for (std::size_t i = 0; i < 2; ++i)
  {
    EXPECT_EQ(results.cheapest[i].n_modes, i == 0 ? 1 : 3);
    EXPECT_EQ(results.cheapest[i].count, 2);
    EXPECT_EQ(results.cheapest[i].h, .5);
  }
}

// E sin(a - (3 + s z) T) = sin(a - 3T) exp(-(s T)²/2), and so on for the square.
TEST(SampleStatistics, OfMotionsAreHeldAgainstThoseAtTheFinalTime)
{
  const scene::Scene scene = random_scene({{"Random/variables", "c: normal 3 0.5"},
                                           {"Sampling/counts", "12"},
                                           {"Problem/solution", "sin(x - c*t)"},
                                           {"Time/final time", "2"},
                                           {"Time/schemes", "velocity Verlet"},
                                           {"Time/critical fractions", "0.5"},
                                           {"Study/norms", "nodal L2"},
                                           {"Study/decisive error", "nodal L2 | exact"}});
  const SamplingPlan plan = make_sampling_plan(scene);
  Record one = exact_record(plan, 0, first)[0];
  one.key.problem = scene.problem.case_names().front();
  const auto exact = study::exact_statistics(scene, one);
  ASSERT_TRUE(exact);
  const auto &points = one.fields["u"].points;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double x = points[i][0], mean = std::sin(x - 6) * std::exp(-.5),
                 square = .5 * (1 - std::cos(2 * (x - 6)) * std::exp(-2.));
    EXPECT_NEAR(exact->mean[i], mean, 1e-12);
    EXPECT_NEAR(exact->deviation[i], std::sqrt(square - mean * mean), 1e-12);
  }
}

TEST(SampleStatistics, OfAQuantityThatIsPartlyThereAreNoneAndThatIsSaid)
{
  const scene::Scene scene = random_scene({});
  const SamplingPlan plan = make_sampling_plan(scene);
  const SamplingResults results = conclude_samples(scene, plan,
                                                   [&](std::size_t i)
                                                   {
                                                     Records record = exact_record(plan, i, first);
                                                     if (i != 2)
                                                       record[0].set("K", 1);
                                                     return record;
                                                   });
  EXPECT_EQ(results.cases[0].sets[1].quantities.count("K"), 0);
  EXPECT_EQ(results.cases[0].sets[1].quantities.count("q"), 1);
  EXPECT_EQ(std::count(results.findings.begin(), results.findings.end(),
                       "K of PA-AC is available for 3 of 4 samples, so that it has no statistics"),
            1);
  // sample by sample, of the larger set: 2 has none
  const CaseStatistics &one = results.cases[0];
  EXPECT_EQ(one.samples, (std::vector<std::size_t>{1, 2, 3, 4}));
  using Values = std::vector<std::optional<double>>;
  EXPECT_EQ(one.values.at("K"), (Values{1., std::nullopt, 1., 1.}));
  Values q;
  for (const std::size_t i : one.samples)
    q.emplace_back(plan.values[i][0]);
  EXPECT_EQ(one.values.at("q"), q);
  EXPECT_EQ(results.variables, (std::vector<std::string>{"c", "d"}));
  EXPECT_EQ(results.points, plan.values);
}

TEST(SampleStatistics, OfRulesSayNothingWithoutAPoint)
{
  const scene::Scene scene = random_scene({});
  const SamplingPlan plan = make_sampling_plan(scene);
  const SamplingResults results = conclude_samples(
      scene, plan,
      [&](std::size_t i)
      { return i == 2 ? failed_record("it was too much") : exact_record(plan, i, first); });
  EXPECT_TRUE(results.is_complete);
  ASSERT_EQ(results.failures.size(), 1);
  EXPECT_EQ(results.failures[0].sample, 2);
  EXPECT_EQ(results.failures[0].reason, "it was too much");
  EXPECT_FALSE(results.cases[0].sets[0].quantities.empty()); // of the one point, which is there
  EXPECT_TRUE(results.cases[0].sets[1].quantities.empty());
  EXPECT_EQ(results.cases[0].sets[1].n_missing, 1);
  EXPECT_FALSE(results.cases[0].sets[1].mean_error);
}

TEST(SampleStatistics, OfIndependentSamplesDoWithoutOne)
{
  const scene::Scene scene =
      random_scene({{"Sampling/rule", "Monte Carlo"}, {"Sampling/counts", "4"}});
  const SamplingPlan plan = make_sampling_plan(scene);
  const SamplingResults results = conclude_samples(
      scene, plan,
      [&](std::size_t i) { return i == 2 ? failed_record("no") : exact_record(plan, i, first); });
  const double mean = (plan.values[0][0] + plan.values[1][0] + plan.values[3][0]) / 3;
  const SetStatistics &set = results.cases[0].sets[0];
  EXPECT_EQ(set.n_missing, 1);
  EXPECT_NEAR(set.quantities.at("q").mean, mean, 1e-15);
  EXPECT_NEAR(set.quantities.at("q").standard_error,
              *set.quantities.at("q").deviation() / std::sqrt(3.), 1e-15);
  EXPECT_NEAR(results.cases[0].field->mean[0], (1 + mean) * .1, 1e-15);
}

TEST(SampleStatistics, OfFilesThatComeTwiceSaySo)
{
  const tests::TextFolder folder("sampled_files");
  const std::string files = folder.write("a.csv", "1\n") + ", " + folder.write("b.csv", "2\n");
  const auto n_said = [&](const std::string &n_samples)
  {
    const scene::Scene scene = random_scene({{"Random/field", "files"},
                                             {"Random/files", files},
                                             {"Sampling/rule", "Monte Carlo"},
                                             {"Sampling/counts", n_samples}});
    const SamplingResults results = conclude(scene, make_sampling_plan(scene), first);
    return std::count_if(results.findings.begin(), results.findings.end(),
                         [&](const std::string &finding) {
                           return finding.find("2 of Random/files in turn") != std::string::npos;
                         });
  };
  EXPECT_EQ(n_said("2"), 0);
  EXPECT_EQ(n_said("3"), 1);
}

TEST(SampleStatistics, ThatAreNotThereLeaveResultsIncomplete)
{
  const scene::Scene scene = random_scene({});
  const SamplingPlan plan = make_sampling_plan(scene);
  const SamplingResults results = conclude_samples(scene, plan,
                                                   [&](std::size_t i) -> std::optional<Records>
                                                   {
                                                     if (i > 0)
                                                       return {};
                                                     return exact_record(plan, i, first);
                                                   });
  EXPECT_FALSE(results.is_complete);
  EXPECT_TRUE(results.failures.empty());
}

// u = e^c x at Gauss points of c in [-1, 1]: the interpolant of two of them against Newton's form
// at the points of the largest set.
TEST(SampleStatistics, HaveTheErrorOfTheInterpolant)
{
  for (const std::string rule : {"tensor", "Chebyshev"})
  {
    const scene::Scene scene = random_scene({{"Random/variables", "c: uniform -1 1"},
                                             {"Sampling/rule", rule},
                                             {"Sampling/counts", "2, 4, 9"},
                                             {"Problem/solution", "exp(c)*x"}});
    const SamplingPlan plan = make_sampling_plan(scene);
    const auto record = [&](std::size_t i)
    {
      Records made = exact_record(plan, i, first);
      analysis::PointField &field = made[0].fields["u"];
      for (std::size_t p = 0; p < field.points.size(); ++p)
        field.values[p] = std::exp(plan.values[i][0]) * field.points[p][0];
      return made;
    };
    const auto sets = study::conclude_samples(scene, plan, record).cases.at(0).sets;
    const auto c = [&](std::size_t set, std::size_t k)
    { return plan.values[plan.sets[set].samples[k]][0]; };
    double largest = 0;
    for (std::size_t k = 0; k < 9; ++k)
    {
      const double at = c(2, k), a = c(0, 0), b = c(0, 1),
                   slope = (std::exp(b) - std::exp(a)) / (b - a);
      largest = std::max(largest, std::abs(std::exp(at) - std::exp(a) - slope * (at - a)));
    }
    const double size = std::sqrt(.25 * (.01 + .16 + .36 + .81));
    ASSERT_TRUE(sets[0].interpolation_error && sets[1].interpolation_error) << rule;
    EXPECT_NEAR(*sets[0].interpolation_error, largest * size, 1e-13) << rule;
    EXPECT_LT(*sets[1].interpolation_error, .02 * *sets[0].interpolation_error) << rule;
    EXPECT_FALSE(sets[2].interpolation_error) << "nothing finer is known";
    // two points: at the ends 1/|node|
    EXPECT_NEAR(*sets[0].lebesgue, rule == "tensor" ? std::sqrt(3.) : std::sqrt(2.), 1e-8);
    EXPECT_EQ(sets[0].lebesgue, sets[0].lebesgue_bound);
    EXPECT_EQ(
        study::sampled_quantity({{}, true, false, {sets[0]}, {}, {}, {}}, "Lebesgue constant"),
        sets[0].lebesgue);
    // one sample that is missing takes from each set that needs it what it says
    const auto without_first = study::conclude_samples(
        scene, plan, [&](std::size_t i) { return i == 0 ? failed_record("failed") : record(i); });
    EXPECT_FALSE(without_first.cases.at(0).sets[0].interpolation_error);
  }
  const auto normal = random_scene({{"Sampling/counts", "1, 2, 3"}});
  const auto sets = conclude(normal, make_sampling_plan(normal), first).cases.at(0).sets;
  EXPECT_FALSE(sets[0].lebesgue || sets[0].interpolation_error) << "a variable is unbounded";
}

TEST(SampleStatistics, ChebyshevsPointsAreOfUniformVariables)
{
  try
  {
    (void)random_scene({{"Sampling/rule", "Chebyshev"}});
    FAIL();
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("normal variables are unbounded"), std::string::npos);
  }
}
