// Plateaus and slow powers: sequences of known laws, and what is said of them.
#include "study/slow_power.h"

#include "study/trend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace plumbline::study;
using Kind = Approach::Kind;

namespace
{
  using Law = std::function<double(double)>;

  std::vector<double> sizes(unsigned int n, double first = 1. / 16)
  {
    std::vector<double> x;
    for (unsigned int i = 0; i < n; ++i)
      x.push_back(first / std::exp2(i));
    return x;
  }

  std::vector<double> errors_of(const Law &law, const std::vector<double> &x)
  {
    std::vector<double> e;
    for (const double one : x)
      e.push_back(law(one));
    return e;
  }

  Trend judged(const std::vector<double> &x, const std::vector<double> &errors)
  {
    Trend trend;
    trend.x = x;
    trend.size = 1;
    trend.round_off = 1e-12;
    trend.values = errors;
    judge(trend);
    return trend;
  }

  bool says(const Trend &trend, const std::string &text)
  {
    return trend.reason.find(text) != std::string::npos;
  }

  // mode I beside a crack by the published surface terms of a linear peridynamic solid, whose net
  // force at the tip is of the size of the root of the horizon (h = π/16, ..., π/512)
  const std::vector<double> force_at_tip = {6.1335e-2, 3.4400e-2, 1.9882e-2,
                                            1.2034e-2, 7.6691e-3, 5.1125e-3};
} // namespace

TEST(FindApproach, tells_a_plateau_from_a_slow_power_however_the_fields_add_up)
{
  struct Row
  {
    Law law;
    Kind kind;
  };
  const std::vector<Row> table = {
      {[](double x) { return .002 + x; }, Kind::plateau},
      {[](double x) { return std::hypot(.002, x); }, Kind::plateau},
      {[](double x) { return .0002 + x * x; }, Kind::plateau},
      {[](double x) { return .1 * std::sqrt(x) + x; }, Kind::slow_power},
      {[](double x) { return std::hypot(.1 * std::sqrt(x), x); }, Kind::slow_power},
      {[](double x) { return .01 * std::sqrt(x) + x * x; }, Kind::slow_power},
      {[](double x) { return .1 * std::pow(x, .6) + x; }, Kind::slow_power}};
  for (std::size_t i = 0; i < table.size(); ++i)
    for (const unsigned int n : {5u, 6u, 7u})
    {
      const auto x = sizes(n);
      const Approach approach = find_approach(x, errors_of(table[i].law, x));
      EXPECT_EQ(approach.kind, table[i].kind) << i << ' ' << n;
      if (table[i].kind == Kind::slow_power)
      {
        EXPECT_NEAR(approach.power, i == 6 ? .6 : .5, 1e-9) << i << ' ' << n;
      }
    }
}

TEST(FindApproach, never_takes_one_for_the_other_whatever_the_noise)
{
  std::mt19937 random(7);
  const Law plateau = [](double x) { return .005 + x; };
  const Law root = [](double x) { return .1 * std::sqrt(x) + x; };
  for (const double size : {.003, .03})
  {
    std::uniform_real_distribution<double> noise(-size, size);
    for (unsigned int n = 4; n <= 7; ++n)
      for (int trial = 0; trial < 5; ++trial)
        for (const bool is_plateau : {false, true})
        {
          const auto x = sizes(n);
          auto e = errors_of(is_plateau ? plateau : root, x);
          for (double &one : e)
            one *= 1 + noise(random);
          EXPECT_NE(find_approach(x, e).kind, is_plateau ? Kind::slow_power : Kind::plateau);
        }
  }
}

TEST(Judge, a_force_at_a_crack_tip_is_a_slow_power_near_one_half)
{
  const Trend trend = judged(sizes(6), force_at_tip);
  EXPECT_EQ(trend.outcome, Outcome::undecided);
  EXPECT_TRUE(says(trend, "a slow power, x^0.45")) << trend.reason;
  for (unsigned int n = 4; n < 6; ++n) // fewer levels do not tell, and it is said
  {
    const Trend fewer = judged(sizes(n), {force_at_tip.begin(), force_at_tip.begin() + n});
    EXPECT_NE(fewer.outcome, Outcome::stalls) << n;
    EXPECT_TRUE(fewer.outcome != Outcome::undecided || says(fewer, "slow power") ||
                says(fewer, "run a finer level"))
        << fewer.reason;
  }
  EXPECT_TRUE(says(judged(sizes(5), {force_at_tip.begin(), force_at_tip.begin() + 5}),
                   "plateau or a slow power x^0.5"));
}

TEST(Judge, a_power_alone_below_three_quarters_is_named)
{
  // mode II by the same terms
  const Trend trend = judged(sizes(5), {5.0463e-2, 3.4793e-2, 2.4151e-2, 1.6852e-2, 1.1837e-2});
  EXPECT_EQ(trend.outcome, Outcome::undecided);
  EXPECT_TRUE(says(trend, "no plateau, but a slow power, x^0.51")) << trend.reason;
}

TEST(Judge, a_plateau_stays_one_where_a_slow_power_does_not_fit)
{
  for (const Law &law : {Law([](double x) { return .02 + .3 * x; }),
                         Law([](double x) { return std::hypot(.02, .3 * x); }),
                         Law([](double x) { return .02 + 3 * x * x; })})
    for (const unsigned int n : {5u, 6u})
    {
      const Trend trend = judged(sizes(n), errors_of(law, sizes(n)));
      EXPECT_EQ(trend.outcome, Outcome::stalls) << trend.reason;
      EXPECT_EQ(trend.leaning, Leaning::none);
    }
  // a patch test at an oblique crack, .96 of the last error
  EXPECT_EQ(judged(sizes(4), {3.3164e-2, 1.9454e-2, 1.4996e-2, 1.4176e-2}).outcome,
            Outcome::stalls);
}

TEST(Judge, logarithms_are_no_plateaus)
{
  const Trend slow =
      judged(sizes(6), errors_of([](double x) { return 1 / std::log(1 / x); }, sizes(6)));
  EXPECT_EQ(slow.outcome, Outcome::undecided) << slow.reason;
  EXPECT_TRUE(says(slow, "a plateau or a logarithm")) << slow.reason;
  for (const double power : {.5, 1.})
  {
    const Law law = [power](double x) { return std::pow(x, power) * std::log(1 / x); };
    EXPECT_NE(judged(sizes(6), errors_of(law, sizes(6))).outcome, Outcome::stalls) << power;
  }
}

TEST(Judge, does_not_fit_what_has_too_few_levels)
{
  for (const Trend &trend :
       {judged(sizes(3), {4e-2, 2e-2, 1e-2}), judged(sizes(4), {1e-3, 2e-14, 1e-14, 1e-14})})
  {
    EXPECT_TRUE(std::isnan(trend.rate));
    EXPECT_TRUE(std::isnan(trend.rate_uncertainty));
    EXPECT_TRUE(std::isnan(trend.plateau));
    EXPECT_TRUE(std::isnan(trend.plateau_uncertainty));
  }
}
