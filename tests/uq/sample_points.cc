// Rules for means over random variables: exactness, weights, and what negative ones do.

#include "uq/sample_points.h"
#include "uq/generator.h"
#include "uq/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace
{
  using namespace plumbline::uq;

  template <class F>
  double mean(const SamplePoints &rule, const F &f)
  {
    double sum = 0;
    for (std::size_t i = 0; i < rule.points.size(); ++i)
      sum += rule.weights[i] * f(rule.points[i]);
    return sum;
  }

  /// Σ |w f|, which rounding goes with.
  template <class F>
  double sum_of_sizes(const SamplePoints &rule, const F &f)
  {
    double sum = 0;
    for (std::size_t i = 0; i < rule.points.size(); ++i)
      sum += std::abs(rule.weights[i] * f(rule.points[i]));
    return sum;
  }

  /// E[x^p] of a standard variable.
  double moment(Law law, unsigned int p)
  {
    if (p % 2 == 1)
      return 0;
    if (law == Law::uniform)
      return 1. / (p + 1);
    double result = 1;
    for (unsigned int k = 1; k < p; k += 2)
      result *= k;
    return result;
  }

  double moment_of(const LineRule &rule, unsigned int p)
  {
    double sum = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i)
      sum += rule.weights[i] * std::pow(rule.nodes[i], p);
    return sum;
  }
} // namespace

TEST(LineRule, GaussIsExactToItsDegreeAndNoFurther)
{
  for (const Law law : {Law::normal, Law::uniform})
    for (unsigned int n = 1; n <= 12; ++n)
    {
      const LineRule rule = gauss_rule(law, n);
      ASSERT_EQ(rule.nodes.size(), n);
      for (unsigned int p = 0; p < 2 * n; ++p)
        EXPECT_NEAR(moment_of(rule, p), moment(law, p), 1e-12 * moment(law, p - p % 2))
            << n << " points, degree " << p;
      EXPECT_GT(std::abs(moment_of(rule, 2 * n) / moment(law, 2 * n) - 1), 1e-8);
    }
}

TEST(LineRule, ClenshawCurtisIsExactToItsDegreeNestedAndPositive)
{
  for (const unsigned int n : {1u, 3u, 5u, 9u, 17u, 33u})
  {
    const LineRule rule = clenshaw_curtis_rule(n), finer = clenshaw_curtis_rule(2 * n - 1);
    for (unsigned int p = 0; p < n; ++p)
      EXPECT_NEAR(moment_of(rule, p), moment(Law::uniform, p), 1e-15) << n << ", degree " << p;
    for (unsigned int i = 0; i < n; ++i)
    {
      EXPECT_GT(rule.weights[i], 0);
      if (n > 1)
      {
        EXPECT_EQ(rule.nodes[i], finer.nodes[2 * i]);
      }
    }
  }
}

TEST(SamplePoints, TensorRulesAreExactInEachVariable)
{
  const SamplePoints rule = tensor_points({Law::normal, Law::uniform}, 4);
  EXPECT_EQ(rule.points.size(), 16);
  EXPECT_EQ(n_tensor_points(2, 4), 16);
  EXPECT_NEAR(mean(rule, [](const auto &x) { return std::pow(x[0], 6) * std::pow(x[1], 4); }),
              15. / 5, 1e-13);
}

// The numbers that Fan et al. 2022, doi:10.1016/j.cma.2022.115340, section 5 rests on: 20
// variables.
TEST(SamplePoints, EquidistantOnesGoFromEndToEnd)
{
  const SamplePoints three = equidistant_points(1, 3);
  EXPECT_EQ(three.points, (std::vector<std::vector<double>>{{-1}, {0}, {1}}));
  EXPECT_EQ(three.weights, (std::vector<double>{.25, .5, .25}));
  EXPECT_EQ(equidistant_points(1, 1).points, (std::vector<std::vector<double>>{{0}}));
  const SamplePoints pairs = equidistant_points(2, 5);
  ASSERT_EQ(pairs.points.size(), 25u);
  EXPECT_EQ(pairs.points.front(), (std::vector<double>{-1, -1}));
  EXPECT_EQ(pairs.points.back(), (std::vector<double>{1, 1}));
  EXPECT_DOUBLE_EQ(mean(pairs, [](const auto &x) { return 1 + 3 * x[0] - 2 * x[1]; }), 1);
  EXPECT_DOUBLE_EQ(mean(pairs, [](const auto &x) { return x[0] * x[0]; }), 1. / 3 + 1. / 24);
}

TEST(SamplePoints, SmolyakOfTwentyVariablesHasAHeavyCentre)
{
  const std::vector<Law> normal(20, Law::normal), uniform(20, Law::uniform);
  const auto centre = [](const SamplePoints &rule)
  {
    return rule.weights[static_cast<std::size_t>(
        std::find(rule.points.begin(), rule.points.end(), std::vector<double>(20, 0)) -
        rule.points.begin())];
  };
  struct Expected
  {
    const std::vector<Law> &laws;
    Growth growth;
    double centre, sizes;
  };
  // centre weights: two points 1 - N; three points 1 - N/3 (Hermite) and 1 - 5N/9 (Legendre)
  for (const auto &[laws, growth, weight, sizes] :
       {Expected{normal, Growth::linear, 1 - 20., 39},
        Expected{normal, Growth::odd, 1 - 20. / 3, 12 + 1. / 3},
        Expected{uniform, Growth::odd, 1 - 20 * 5. / 9, 21 + 2. / 9}})
  {
    const SamplePoints rule = smolyak_points(laws, 1, growth);
    EXPECT_EQ(rule.points.size(), 41);
    EXPECT_GE(n_smolyak_points(laws, 1, growth), 41);
    EXPECT_NEAR(centre(rule), weight, 1e-13);
    EXPECT_NEAR(rule.sum_of_sizes(), sizes, 1e-12);
    // it is exact for squares, and sees no product of squares
    EXPECT_NEAR(mean(rule, [](const auto &x) { return x[3] * x[3]; }), moment(laws.front(), 2),
                1e-13);
    EXPECT_NEAR(mean(rule, [](const auto &x) { return x[3] * x[3] * x[7] * x[7]; }), 0, 1e-13);
  }
  EXPECT_NEAR(smolyak_points(normal, 1, Growth::linear).noise(), std::sqrt(361 + 40 * .25), 1e-12);
  // centre -17/3, forty of 1/6
  EXPECT_NEAR(smolyak_points(normal, 1, Growth::odd).noise(), std::sqrt(299.) / 3, 1e-12);
  EXPECT_NEAR(smolyak_points(normal, 1, Growth::odd).noise(), 5.8, .05); // to two digits
  EXPECT_EQ(smolyak_points(normal, 2, Growth::linear).points.size(), 841);
  EXPECT_EQ(smolyak_points(normal, 2, Growth::odd).points.size(), 881);
  EXPECT_EQ(smolyak_points(normal, 2, Growth::doubling).points.size(), 921);
}

TEST(SamplePoints, SmolyakIsExactToTotalDegree)
{
  const std::vector<Law> laws = {Law::normal, Law::uniform, Law::normal};
  for (unsigned int level = 0; level <= 4; ++level)
    for (const Growth growth : {Growth::linear, Growth::odd, Growth::doubling})
    {
      const SamplePoints rule = smolyak_points(laws, level, growth);
      EXPECT_LE(static_cast<double>(rule.points.size()), n_smolyak_points(laws, level, growth));
      for (unsigned int p = 0; p <= 2 * level + 1; ++p)
        for (unsigned int q = 0; p + q <= 2 * level + 1; ++q)
          for (unsigned int r = 0; p + q + r <= 2 * level + 1; ++r)
          {
            const auto power = [&](const auto &x)
            { return std::pow(x[0], p) * std::pow(x[1], q) * std::pow(x[2], r); };
            EXPECT_NEAR(mean(rule, power),
                        moment(Law::normal, p) * moment(Law::uniform, q) * moment(Law::normal, r),
                        1e-13 * sum_of_sizes(rule, power))
                << level << ": " << p << ' ' << q << ' ' << r;
          }
    }
}

TEST(LineRule, GenzAndKeistersPointsAreNestedAndReachTheirDegree)
{
  const std::array<std::pair<std::size_t, unsigned int>, n_genz_keister_rules> expected = {
      {{1, 1}, {3, 5}, {9, 15}, {19, 29}, {35, 51}}};
  std::vector<double> before;
  for (unsigned int level = 1; level <= n_genz_keister_rules; ++level)
  {
    const LineRule rule = genz_keister_rule(level);
    const auto [n, degree] = expected[level - 1];
    ASSERT_EQ(rule.nodes.size(), n);
    EXPECT_TRUE(std::includes(rule.nodes.begin(), rule.nodes.end(), before.begin(), before.end()));
    before = rule.nodes;
    for (unsigned int p = 0; p <= degree + 1; ++p)
    {
      double sum = 0, size = 0;
      for (std::size_t i = 0; i < n; ++i)
      {
        const double part = rule.weights[i] * std::pow(rule.nodes[i], p);
        sum += part;
        size += std::abs(part);
      }
      if (p <= degree)
      {
        EXPECT_NEAR(sum, moment(Law::normal, p), (level < 5 ? 1e-13 : 1e-11) * size)
            << level << ' ' << p;
      }
      else if (level < 5)
      {
        EXPECT_GT(std::abs(sum - moment(Law::normal, p)), 1e-11 * size) << level;
      }
    }
  }
  // as printed, of 9 points
  const LineRule nine = genz_keister_rule(3);
  EXPECT_NEAR(nine.nodes[5], .74109534999454085, 1e-15);
  EXPECT_NEAR(nine.nodes[6], std::sqrt(3.), 1e-15);
}

TEST(SamplePoints, NestedSmolyakCountsItsPoints)
{
  const auto n_points = [](std::size_t n_variables, unsigned int level)
  {
    return smolyak_points(std::vector<Law>(n_variables, Law::uniform), level, Growth::nested)
        .points.size();
  };
  for (const Law law : {Law::uniform, Law::normal})
    for (unsigned int level = 0; level <= 4; ++level)
    {
      const std::vector<Law> two(2, law);
      EXPECT_EQ(static_cast<double>(smolyak_points(two, level, Growth::nested).points.size()),
                n_smolyak_points(two, level, Growth::nested))
          << level;
    }
  // of three variables and level 1 the middle one's weight is 1 - 3 + 3 · 2/3
  EXPECT_EQ(n_points(3, 1), 6);
}

// Coefficients of 1/(1-z)^2N+1 and, with odd numbers, of (1+z)^N/(1-z)^2N+1.
TEST(SamplePoints, CountsOfHighLevelsAreThereBeforeAnyPoint)
{
  const auto binomial = [](unsigned int n, unsigned int k)
  {
    double result = 1;
    for (unsigned int i = 1; i <= k; ++i)
      result *= static_cast<double>(n - k + i) / i;
    return result;
  };
  const std::vector<Law> normal(20, Law::normal), one(1, Law::uniform);
  for (const unsigned int level : {20u, 31u, 32u})
  {
    double odd = 0;
    for (unsigned int k = 0; k <= std::min(20u, level); ++k)
      odd += binomial(20, k) * binomial(level - k + 40, 40);
    EXPECT_NEAR(n_smolyak_points(normal, level, Growth::linear) / binomial(level + 40, 40), 1,
                1e-12);
    EXPECT_NEAR(n_smolyak_points(normal, level, Growth::odd) / odd, 1, 1e-12);
    EXPECT_EQ(n_smolyak_points(normal, level, Growth::doubling), std::exp2(level + 1.) - 1);
    EXPECT_EQ(n_smolyak_points(one, level, Growth::nested), std::exp2(level) + 1);
  }
  EXPECT_EQ(n_smolyak_points(one, 10, Growth::nested), 1025);
  EXPECT_EQ(n_smolyak_points(one, 9, Growth::doubling), 2036); // Σ (2^l - 1), l = 1 ... 10
  // at once, and finite
  constexpr unsigned int billion = 1000000000;
  EXPECT_EQ(n_smolyak_points(normal, billion, Growth::odd), 2e9 + 1);
  EXPECT_EQ(n_smolyak_points(one, billion, Growth::nested), 1e300);
  EXPECT_EQ(n_smolyak_points(std::vector<Law>(10000, Law::normal), 300, Growth::odd), 1e300);
  EXPECT_EQ(n_tensor_points(1, billion), 1e9);
  EXPECT_EQ(n_tensor_points(10000, 2), 1e300);
}

TEST(SamplePoints, VarianceOfSmolyakCanBeNegativeAndHasNoRoot)
{
  const SamplePoints rule = smolyak_points(std::vector<Law>(20, Law::normal), 1, Growth::odd);
  std::vector<double> values;
  for (const auto &x : rule.points)
  {
    double sum = 0;
    for (const double one : x)
      sum += one * one;
    values.push_back(sum);
  }
  const Statistics found = statistics(values, rule.weights, false);
  EXPECT_NEAR(found.mean, 20, 1e-12);
  EXPECT_NEAR(found.variance, -340, 1e-9); // exact 40: 20 · 3 of x⁴ less 400, no products
  EXPECT_FALSE(found.deviation());
}

TEST(SamplePoints, RandomOnesHaveTheirLawAndFirstOnesStay)
{
  const std::vector<Law> laws = {Law::normal, Law::uniform};
  constexpr std::size_t n = 20000;
  for (const bool is_quasi : {false, true})
  {
    const auto draw = [&](std::size_t count) {
      return is_quasi ? quasi_monte_carlo_points(laws, count) : monte_carlo_points(laws, count, 7);
    };
    const SamplePoints few = draw(10), many = draw(n);
    for (std::size_t i = 0; i < few.points.size(); ++i)
      EXPECT_EQ(few.points[i], many.points[i]);
    // five deviations of the mean of independent samples; quasi-random ones are ten times closer
    const double five = 5 / std::sqrt(static_cast<double>(n)) * (is_quasi ? .1 : 1);
    EXPECT_NEAR(mean(many, [](const auto &x) { return x[0]; }), 0, five);
    EXPECT_NEAR(mean(many, [](const auto &x) { return x[0] * x[0]; }), 1, std::sqrt(2.) * five);
    EXPECT_NEAR(mean(many, [](const auto &x) { return x[1] * x[1]; }), 1. / 3, .3 * five);
    EXPECT_NEAR(mean(many, [](const auto &x) { return x[0] * x[1]; }), 0, .58 * five);
    EXPECT_NEAR(mean(many, [](const auto &x) { return x[0] < 1 ? 1. : 0.; }),
                .5 * std::erfc(-std::sqrt(.5)), .37 * five);
  }
  EXPECT_NE(monte_carlo_points(laws, 1, 1).points, monte_carlo_points(laws, 1, 2).points);
}

// Factors of tests 1 and 2 of Fan et al. 2022, sections 4.1 and 4.2: means and deviations of
// 1/(2 + sin 5ξ), ξ ~ N(0, .1²), and 1/(3 + sin ξ1 + sin ξ2), to the digits that many points give.
TEST(SamplePoints, FactorsOfPublishedTestsConverge)
{
  const auto one = [](const std::vector<double> &x) { return 1 / (2 + std::sin(.5 * x[0])); };
  const auto two = [](const std::vector<double> &x)
  { return 1 / (3 + std::sin(x[0]) + std::sin(x[1])); };
  const auto moments = [](const SamplePoints &rule, const auto &f)
  {
    std::vector<double> values;
    for (const auto &x : rule.points)
      values.push_back(f(x));
    return statistics(values, rule.weights, false);
  };
  const Statistics first = moments(tensor_points({Law::normal}, 60), one),
                   second = moments(tensor_points({2, Law::normal}, 120), two);
  EXPECT_NEAR(first.mean, .527867400302426, 1e-14);
  EXPECT_NEAR(*first.deviation(), .130571622348726, 1e-13);
  EXPECT_NEAR(second.mean, .375583946493748, 1e-12);
  EXPECT_NEAR(*second.deviation(), .149155943140308, 1e-11);
  const auto expect_errors =
      [&](const Statistics &found, const Statistics &exact, double of_mean, double of_deviation)
  {
    EXPECT_NEAR(std::abs(found.mean - exact.mean), of_mean, .05 * of_mean);
    EXPECT_NEAR(std::abs(*found.deviation() - *exact.deviation()), of_deviation,
                .05 * of_deviation);
  };
  struct Errors
  {
    unsigned int n;
    double of_mean, of_deviation;
  };
  for (const Errors &known : {Errors{1, 2.8e-2, 1.31e-1},
                              {2, 2.6e-3, 3.4e-3},
                              {3, 4.1e-4, 4.1e-3},
                              {5, 2.1e-6, 2.6e-4},
                              {8, 2.3e-7, 1.4e-5},
                              {15, 1.4e-10, 3.8e-8}})
    expect_errors(moments(tensor_points({Law::normal}, known.n), one), first, known.of_mean,
                  known.of_deviation);
  for (const Errors &known :
       {Errors{4, 8.9e-4, 7.8e-3}, {10, 4.5e-5, 8.4e-4}, {15, 1.8e-5, 1.4e-4}})
    expect_errors(moments(tensor_points({2, Law::normal}, known.n), two), second, known.of_mean,
                  known.of_deviation);
}

TEST(Statistics, OfIndependentSamplesTakeOneLess)
{
  const Statistics found = statistics({1, 2, 3, 6}, {.25, .25, .25, .25}, true);
  EXPECT_EQ(found.mean, 3);
  EXPECT_NEAR(found.variance, 14. / 3, 1e-15);
  EXPECT_NEAR(found.standard_error, std::sqrt(14. / 12), 1e-15);
  EXPECT_EQ(found.least, 1);
  EXPECT_EQ(found.largest, 6);
  EXPECT_EQ(histogram({1, 2, 3, 6}, 5), (std::vector<std::size_t>{1, 1, 1, 0, 1}));
}

// Student's t of one degree of freedom is Cauchy's law; of two the quantile is a square root.
TEST(Statistics, IntervalsAreStudents)
{
  EXPECT_NEAR(confidence_factor(2), std::tan(.475 * M_PI), 1e-10);
  EXPECT_NEAR(confidence_factor(3), .95 * std::sqrt(2 / (4 * .975 * .025)), 1e-12);
  EXPECT_NEAR(confidence_factor(1000000), std::sqrt(2.) * 1.3859038243496777, 1e-5); // erf = .95
  const Statistics found = statistics({1, 2, 3, 6}, {.25, .25, .25, .25}, true);
  EXPECT_NEAR(found.confidence, confidence_factor(4) * std::sqrt(14. / 12), 1e-14);
  EXPECT_EQ(statistics({1, 2, 3, 6}, {.25, .25, .25, .25}, false).confidence, 0);
}

TEST(Statistics, IntervalsHoldTheMeanNinetyFiveTimesOfAHundred)
{
  constexpr std::size_t n = 5, n_trials = 20000;
  Generator generator(1);
  std::size_t n_constrained = 0;
  for (std::size_t i = 0; i < n_trials; ++i)
  {
    std::vector<double> values;
    for (std::size_t k = 0; k < n; ++k)
      values.push_back(3 + 2 * generator.normal());
    const Statistics found = statistics(values, std::vector<double>(n, 1. / n), true);
    n_constrained += std::abs(found.mean - 3) <= found.confidence ? 1 : 0;
  }
  // four deviations of a count; 1.96 standard errors would hold it in 88 %
  const double share = static_cast<double>(n_constrained) / n_trials;
  EXPECT_NEAR(share, .95, 4 * std::sqrt(.95 * .05 / n_trials));
}

// What is the same at all samples that count has no variance, whatever the first one was.
TEST(Statistics, VariancesThatRoundingMakesNegativeAreNone)
{
  FieldSums sums;
  constexpr std::size_t n = 100;
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i)
    values[i] = 1 + .1 * static_cast<double>(i);
  sums.add(std::vector<double>(n, .3), 0);
  for (const double weight : {.3, -1.7, .1, 2.3})
    sums.add(values, weight);
  for (const double one : sums.variance())
  {
    EXPECT_GE(one, 0);
    EXPECT_LT(one, 1e-10);
  }
}

TEST(Statistics, OfFieldsAreThoseOfEachValue)
{
  const SamplePoints rule = smolyak_points({2, Law::normal}, 2, Growth::odd);
  FieldSums sums;
  std::vector<double> values;
  for (std::size_t i = 0; i < rule.points.size(); ++i)
  {
    values.push_back(1e3 + std::sin(rule.points[i][0]) + rule.points[i][1]);
    sums.add({values.back(), 7}, rule.weights[i]);
  }
  const Statistics one = statistics(values, rule.weights, false);
  EXPECT_NEAR(sums.mean()[0], one.mean, 1e-14 * 1e3);
  EXPECT_NEAR(sums.variance()[0], one.variance, 1e-12);
  EXPECT_EQ(sums.mean()[1], 7);
  EXPECT_EQ(sums.variance()[1], 0);
}
