// Statistics over samples: sets that share them, samples that failed, negative variances, exact
// fields, and what is expected.

#include "study/sampling.h"

#include "base/error.h"
#include "study/exact_statistics.h"
#include "tests/text_folder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace plumbline;
  using study::CaseStatistics;
  using study::make_sampling_plan;
  using study::SampleCase;
  using study::SampleRecord;
  using study::SamplingPlan;
  using study::SamplingResults;
  using study::SetStatistics;

  using Settings = std::vector<scene::Override>;

  /// u = (1 + c) x on the unit square, c ~ N(0, .2²), and d uniform on (2, 4).
  scene::Scene random_scene(const Settings &settings)
  {
    Settings all = {{"Random/variables", "c: normal 0 0.2; d: uniform 2 4"},
                    {"Sampling/rule", "tensor"},
                    {"Sampling/counts", "1, 2"},
                    {"Problem/solution", "(1 + c)*x"},
                    {"Methods/names", "PA-AC"},
                    {"Study/h", "0.25"}};
    all.insert(all.end(), settings.begin(), settings.end());
    return scene::parse_scene("random", "", all);
  }

  /// A sample whose field at four places is the exact one, and whose quantity is a given function
  /// of the variables.
  SampleRecord exact_record(const SamplingPlan &plan, std::size_t sample,
                            const std::function<double(const std::vector<double> &)> &quantity)
  {
    const std::vector<double> &values = plan.values[sample];
    SampleCase one;
    one.method = "PA-AC";
    one.problem = "u";
    one.series = "m = 3";
    one.h = .25;
    one.horizon = .75;
    one.seconds = 1;
    one.quantities["q"] = quantity(values);
    one.field.x = {.1, .4, .6, .9};
    one.field.y = {.1, .1, .9, .9};
    one.field.area.assign(4, .25);
    for (const double x : one.field.x)
      one.field.values.push_back((1 + values[0]) * x);
    return {sample, "", {one}};
  }

  double first(const std::vector<double> &values)
  {
    return values[0];
  }

  SamplingResults conclude(const scene::Scene &scene, const SamplingPlan &plan,
                           const std::function<double(const std::vector<double> &)> &quantity)
  {
    return conclude_samples(scene, plan,
                            [&](std::size_t i) { return exact_record(plan, i, quantity); });
  }
} // namespace

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

TEST(SampleStatistics, OfGrowthSayWhichSchemeTheyAreOf)
{
  for (const bool has_surface_terms : {false, true})
  {
    scene::Scene scene;
    scene.fracture.toughness = "1";
    scene.fracture.has_surface_terms = has_surface_terms;
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
                         SampleRecord record = exact_record(plan, i, first);
                         for (double &value : record.cases[0].field.values)
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
                              SampleRecord record = exact_record(plan, i, first);
                              record.cases.push_back(record.cases[0]);
                              SampleCase &fine = record.cases[1];
                              fine.level = 1;
                              fine.h = .125;
                              fine.seconds = seconds_of_fine;
                              for (double &value : fine.field.values)
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
  const SamplingResults results =
      conclude_samples(scene, plan,
                       [&](std::size_t sample)
                       {
                         SampleRecord record{sample, "", {}};
                         for (const unsigned int level : {0u, 1u})
                         {
                           SampleCase one;
                           one.method = "PA-AC";
                           one.series = "m = 3";
                           one.level = level;
                           one.h = level == 0 ? .5 : .25;
                           one.seconds = level == 0 ? 1 : .5;
                           const int n = level == 0 ? 2 : 4;
                           for (int i = 0; i < n * n; ++i)
                           {
                             one.field.x.push_back((i % n + .5) * one.h);
                             one.field.y.push_back((std::floor(i / n) + .5) * one.h);
                             one.field.area.push_back(one.h * one.h);
                             double value = one.field.x.back() + (level == 0 ? of_h : 0);
                             for (std::size_t d = 0; d < 3; ++d)
                               value += part[d] * plan.values[sample][d] * plan.values[sample][d];
                             one.field.values.push_back(value);
                           }
                           record.cases.push_back(one);
                         }
                         return record;
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
  SampleCase one = exact_record(plan, 0, first).cases[0];
  one.problem = scene.problem.case_names().front();
  const auto exact = study::exact_statistics(scene, one);
  ASSERT_TRUE(exact);
  for (std::size_t i = 0; i < one.field.x.size(); ++i)
  {
    const double x = one.field.x[i], mean = std::sin(x - 6) * std::exp(-.5),
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
                                                     SampleRecord record =
                                                         exact_record(plan, i, first);
                                                     if (i != 2)
                                                       record.cases[0].quantities["K"] = 1;
                                                     return record;
                                                   });
  EXPECT_EQ(results.cases[0].sets[1].quantities.count("K"), 0);
  EXPECT_EQ(results.cases[0].sets[1].quantities.count("q"), 1);
  EXPECT_EQ(std::count(results.findings.begin(), results.findings.end(),
                       "K of PA-AC is there for 3 of 4 samples, so that it has no statistics"),
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
      [&](std::size_t i) {
        return i == 2 ? SampleRecord{2, "it was too much", {}} : exact_record(plan, i, first);
      });
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
  const SamplingResults results =
      conclude_samples(scene, plan,
                       [&](std::size_t i) {
                         return i == 2 ? SampleRecord{2, "no", {}} : exact_record(plan, i, first);
                       });
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
                                                   [&](std::size_t i) -> std::optional<SampleRecord>
                                                   {
                                                     if (i > 0)
                                                       return {};
                                                     return exact_record(plan, i, first);
                                                   });
  EXPECT_FALSE(results.is_complete);
  EXPECT_TRUE(results.failures.empty());
}

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
  const random::Statistics &found = results.cases[0].sets[0].quantities.at("q");
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
      SampleRecord record{sample, "", {}};
      for (const unsigned int level : {0u, 1u})
      {
        SampleCase one;
        one.method = "PA-AC";
        one.series = "m = 3";
        one.level = level;
        one.h = level == 0 ? .5 : .25;
        const int n = level == 0 ? 2 : 4;
        for (int i = 0; i < n * n; ++i)
        {
          one.field.x.push_back((i % n + .5) * one.h);
          one.field.y.push_back((std::floor(i / n) + .5) * one.h);
          one.field.area.push_back(one.h * one.h);
          one.field.values.push_back(one.field.x.back() < .5 ? sum : 3); // constant on the right
        }
        record.cases.push_back(one);
      }
      return record;
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
