#include "study/trend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace plumbline::study;

namespace
{
  const std::vector<double> h = {.1, .05, .025, .0125, .00625};

  Trend judged(const std::vector<double> &x, const std::vector<double> &errors)
  {
    Trend trend;
    trend.x = x;
    trend.size = 1;
    trend.round_off = 1e-10;
    trend.values = errors;
    judge(trend);
    return trend;
  }

  template <class Error>
  Trend judged(const Error &error)
  {
    std::vector<double> errors;
    for (const double size : h)
      errors.push_back(error(size));
    return judged(h, errors);
  }
} // namespace

TEST(FitPlateau, recovers_the_parameters_of_an_exact_sequence)
{
  std::vector<double> errors;
  for (const double size : h)
    errors.push_back(.0123 + .4 * std::pow(size, 1.25));
  const PlateauFit fit = fit_plateau(h, errors);
  EXPECT_NEAR(fit.a, .0123, 1e-6);
  EXPECT_NEAR(fit.b, .4, 1e-3);
  EXPECT_NEAR(fit.p, 1.25, .01);
  EXPECT_LT(fit.a_uncertainty, 1e-5);
}

TEST(FitSlope, is_exact_for_a_power_and_uncertain_for_noise)
{
  EXPECT_NEAR(fit_slope({1, .5, .25}, {8, 2, .5}).value, 2, 1e-12);
  EXPECT_NEAR(fit_slope({1, .5, .25}, {8, 2, .5}).uncertainty, 0, 1e-12);
  EXPECT_GT(fit_slope({1, .5, .25}, {8, 1, .5}).uncertainty, .1);
}

TEST(Rates, are_observed_between_errors_above_round_off_alone)
{
  const Trend trend = judged(h, {1e-6, 2.5e-7, 1e-10, 1e-14, 1e-9});
  ASSERT_EQ(trend.rates.size(), 4u);
  EXPECT_NEAR(observed_rate(trend, 1), 2, 1e-12);
  for (const std::size_t i : {0, 2, 3, 4, 5})
    EXPECT_TRUE(std::isnan(observed_rate(trend, i))) << i;
  EXPECT_TRUE(std::isnan(last_rate(trend)));
  EXPECT_NEAR(last_rate(judged(h, {1, .5, .25, .125, .0625})), 1, 1e-12);
  EXPECT_TRUE(std::isnan(last_rate({})));
}

TEST(Judge, a_power_converges_with_its_rate)
{
  for (const double rate : {1., 2., 4.})
  {
    const Trend trend = judged([&](double x) { return .3 * std::pow(x, rate); });
    EXPECT_EQ(trend.outcome, Outcome::converges);
    EXPECT_NEAR(trend.rate, rate, 1e-6);
    ASSERT_EQ(trend.rates.size(), 4u);
    EXPECT_NEAR(trend.rates[0], rate, 1e-12);
  }
}

TEST(Judge, a_plateau_stalls_even_while_the_error_still_falls)
{
  EXPECT_EQ(judged([](double x) { return .0125 + .04 * x; }).outcome, Outcome::stalls);
  EXPECT_EQ(judged([](double x) { return .0125 + .4 * x; }).outcome, Outcome::stalls);
  // IPA-AC, m = 3, of Yang & Yin, table 3
  EXPECT_EQ(judged(h, {1.62e-2, 1.42e-2, 1.32e-2, 1.27e-2, 1.25e-2}).outcome, Outcome::stalls);
}

TEST(Judge, an_error_that_grows_again_stalls)
{
  EXPECT_EQ(judged(h, {5e-2, 1.4e-2, 2.9e-3, 1e-2, 1.5e-2}).outcome, Outcome::stalls);
}

TEST(Judge, a_ragged_error_is_not_called_either_way)
{
  const Trend trend = judged(h, {1e-2, 6e-3, 5e-3, 2.4e-3, 2.1e-3});
  EXPECT_EQ(trend.outcome, Outcome::undecided);
  EXPECT_NE(trend.reason.find("run a finer level"), std::string::npos) << trend.reason;
}

TEST(Judge, round_off_converges_and_levels_at_round_off_do_not_count)
{
  EXPECT_EQ(judged(h, {1e-14, 3e-14, 1e-13, 4e-13, 2e-12}).outcome, Outcome::converges);
  EXPECT_EQ(judged(h, {1e-3, 6.25e-5, 3.9e-6, 2.4e-7, 2e-11}).outcome, Outcome::converges);
}

// Of x³ at 450000 < x < 450001: the bound on round-off, for values of 1e17, is above errors that
// are smooth.
TEST(Judge, errors_that_follow_a_law_are_no_round_off)
{
  Trend trend;
  trend.x = {.1, .05, .025, .0125};
  trend.size = 6e11;
  trend.round_off = 1.6e5;
  trend.values = {12734, 11237, 10521, 10170};
  judge(trend);
  EXPECT_EQ(trend.outcome, Outcome::stalls) << trend.reason;
  trend.values = {12734, 9237, 10521, 10170}; // erratic
  judge(trend);
  EXPECT_EQ(trend.outcome, Outcome::converges) << trend.reason;
  trend.values = {1e-12, 1e-12, 1e-12, 1e-12}; // a last digit
  judge(trend);
  EXPECT_EQ(trend.outcome, Outcome::converges) << trend.reason;
}

TEST(Judge, round_off_that_is_not_small_beside_the_solution_decides_nothing)
{
  Trend trend;
  trend.x = {.1, .05, .025, .0125};
  trend.values = {2.6e-4, 9e-5, 6e-5, 5e-5}; // a stall that 1e-10 of an offset of 1e6 would hide
  trend.size = .02;
  trend.round_off = 1e-4;
  judge(trend);
  EXPECT_EQ(trend.outcome, Outcome::undecided);
  EXPECT_NE(trend.reason.find("subtract a constant"), std::string::npos) << trend.reason;
  trend.round_off = 1e-6;
  judge(trend);
  EXPECT_EQ(trend.outcome, Outcome::stalls);
}

TEST(Judge, fewer_than_four_levels_are_not_enough)
{
  EXPECT_EQ(judged({.1, .05, .025}, {1e-2, 2.5e-3, 6.25e-4}).outcome, Outcome::undecided);
  EXPECT_EQ(judged({}, {}).outcome, Outcome::undecided);
}

TEST(Judge, the_unit_of_the_solution_does_not_matter)
{
  const std::vector<std::vector<double>> sequences = {{1.62e-2, 1.42e-2, 1.32e-2, 1.27e-2, 1.25e-2},
                                                      {1e-2, 2.5e-3, 6.2e-4, 1.6e-4, 4e-5},
                                                      {1e-14, 3e-14, 1e-13, 4e-13, 2e-12},
                                                      {5e-2, 1.4e-2, 2.9e-3, 1e-2, 1.5e-2}};
  for (const auto &errors : sequences)
    for (const double scale : {1e-9, 1e6})
    {
      Trend trend;
      trend.x = h;
      trend.size = scale;
      trend.round_off = 1e-10 * scale;
      for (const double error : errors)
        trend.values.push_back(scale * error);
      judge(trend);
      EXPECT_EQ(trend.outcome, judged(h, errors).outcome) << scale;
    }
}

TEST(Judge, a_plateau_that_noise_hides_is_not_called_convergence)
{
  const std::vector<double> four = {.1, .05, .025, .0125};
  unsigned int n_converges = 0;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-.2, .2);
  for (int trial = 0; trial < 200; ++trial)
  {
    std::vector<double> errors;
    for (const double size : four)
      errors.push_back((.01 + size) * (1 + noise(random)));
    n_converges += judged(four, errors).outcome == Outcome::converges ? 1 : 0;
  }
  EXPECT_LT(n_converges, 10u);
  // the errors of a rule for a load with a jump: a rate, but no certainty
  EXPECT_NE(judged(four, {4.9e-3, 8.2e-3, 2.3e-3, 1.66e-3}).outcome, Outcome::converges);
}

// ---- where the judge draws its lines: a sequence on each side
// ------------------------------------

TEST(FitSlope, has_the_standard_error_of_a_regression_with_two_parameters)
{
  // log2 e = 3, 0, -1 at log2 x = 0, -1, -2: slope 2, residuals 1/3, -2/3, 1/3, Σ (x - mean)² = 2
  const Slope slope = fit_slope({1, .5, .25}, {8, 1, .5});
  EXPECT_NEAR(slope.value, 2, 1e-14);
  EXPECT_NEAR(slope.uncertainty, std::sqrt((6. / 9) / (3 - 2) / 2), 1e-14);
}

TEST(Judge, a_plateau_is_nil_below_a_tenth_of_the_last_error_and_counts_above)
{
  // the fit's a over the last error: .05, .2 and .3, without noise
  for (const auto &[a, outcome] : {std::pair{1e-3 * .05 / .95, Outcome::converges},
                                   {1e-3 * .2 / .8, Outcome::stalls},
                                   {1e-3 * .3 / .7, Outcome::stalls}})
  {
    std::vector<double> errors;
    for (const double size : h)
      errors.push_back(a + 1e-3 * std::pow(size / h.back(), 2));
    EXPECT_EQ(judged(h, errors).outcome, outcome) << a;
  }
  // .25 of the last error and 19 uncertainties, to two digits: the same with a root of x
  const Trend either = judged(h, {6.8e-3, 2e-3, 5.8e-4, 1.8e-4, 6.3e-5});
  EXPECT_EQ(either.outcome, Outcome::undecided);
  EXPECT_NE(either.reason.find("plateau or a slow power x^0.5"), std::string::npos)
      << either.reason;
  // .22 of the last error, but smaller than its uncertainty
  EXPECT_EQ(judged(h, {6e-3, 1.8e-3, 5.1e-4, 1.5e-4, 5.2e-5}).outcome, Outcome::converges);
}

TEST(Judge, a_plateau_that_is_large_but_uncertain_decides_nothing)
{
  // .74 of the last error, 1.8 uncertainties; the errors themselves still fall at rate .9
  const Trend uncertain = judged(h, {9.3e-3, 2.9e-3, 1.1e-3, 5.7e-4, 3.1e-4});
  EXPECT_EQ(uncertain.outcome, Outcome::undecided);
  EXPECT_EQ(uncertain.reason.find("a plateau that is neither nil nor certain"), 0u)
      << uncertain.reason;
  // .22 of the last error, 6 uncertainties: a small one must be ten times its own
  EXPECT_EQ(judged(h, {7.3e-2, 4.4e-2, 2.7e-2, 1.7e-2, 1.1e-2}).outcome, Outcome::undecided);
}

TEST(Judge, an_uncertain_plateau_stalls_only_where_the_error_flattens)
{
  // .77 of the last error, 4.8 uncertainties, but the errors fall at rate 3.5, 2.9, 1.4: IPA-AC on
  // a disk at m = 1.25 ... 3.5, which converges
  EXPECT_EQ(judged({.4, .283, .2, .1414}, {1.46e-1, 4.29e-2, 1.56e-2, 9.55e-3}).outcome,
            Outcome::undecided);
  // .75 of the last error, 3.3 uncertainties, rates 1.2, .8, .6: .045 x^.5 + .3 x^2.3 fits better
  const Trend either = judged({.4, .2, .1, .05}, {6e-2, 2.6e-2, 1.5e-2, 1e-2});
  EXPECT_EQ(either.outcome, Outcome::undecided);
  EXPECT_EQ(either.leaning, Leaning::plateau_or_power);
  // .9 of the last error, 5 uncertainties, rates 1.2, .7, .3: slower than any root
  EXPECT_EQ(judged({.4, .2, .1, .05}, {6e-2, 2.6e-2, 1.6e-2, 1.3e-2}).outcome, Outcome::stalls);
}

TEST(Judge, a_rate_must_surely_be_three_quarters)
{
  const auto of_rate = [](double rate)
  { return judged([=](double x) { return .3 * std::pow(x, rate); }).outcome; };
  EXPECT_EQ(of_rate(.6), Outcome::undecided);
  EXPECT_EQ(of_rate(.7), Outcome::undecided);
  EXPECT_EQ(of_rate(.8), Outcome::converges);
  // .98 ± .19, no plateau: two standard errors below, it is .6
  EXPECT_EQ(judged(h, {4.5e-2, 2e-2, 9.4e-3, 6e-3, 2.4e-3}).outcome, Outcome::undecided);
}

TEST(Judge, an_error_grows_again_from_twice_its_least)
{
  EXPECT_EQ(judged(h, {6.4e-2, 2e-2, 1.5e-3, 1.1e-3, 5.4e-3}).outcome, Outcome::stalls); // 4.9
  EXPECT_EQ(judged(h, {5.3e-2, 2.9e-3, 2.7e-3, 1e-2, 4.4e-3}).outcome,
            Outcome::undecided); // 1.6
}

TEST(Judge, a_level_that_is_exact_by_chance_does_not_count)
{
  EXPECT_EQ(judged({.2, .1, .05, .025, .0125}, {1.2e-2, 3e-3, 1e-14, 1.9e-4, 4.7e-5}).outcome,
            Outcome::converges);
  // four levels, of which three count
  EXPECT_EQ(judged({.1, .05, .025, .0125}, {3e-3, 1e-14, 1.9e-4, 4.7e-5}).outcome,
            Outcome::undecided);
}
