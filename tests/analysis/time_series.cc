#include "analysis/time_series.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using analysis::TimeSeries;
using analysis::Vector;

TEST(TimeSeries, resolves_what_is_smooth_and_differentiates_it)
{
  const auto at = [](double t) { return Vector{std::sin(3 * t), std::exp(-t), 7}; };
  const TimeSeries u = TimeSeries::resolve(at, 2, 1e-11, "u");
  EXPECT_EQ(u.n_points(), 33u);
  EXPECT_LE(u.error(), 1e-11);
  const TimeSeries v = u.derivative(), a = v.derivative();
  for (const double t : {0., .1, .77, 1.3, 2.})
  {
    EXPECT_NEAR(u.at(t)[0], std::sin(3 * t), 1e-13);
    EXPECT_NEAR(v.at(t)[0], 3 * std::cos(3 * t), 1e-11);
    EXPECT_NEAR(a.at(t)[0], -9 * std::sin(3 * t), 1e-8);
    EXPECT_NEAR(a.at(t)[1], std::exp(-t), 1e-8);
    EXPECT_NEAR(v.at(t)[2], 0, 1e-12);
  }
}

TEST(TimeSeries, sums_with_what_does_not_change)
{
  TimeSeries sum(Vector{1, 2});
  EXPECT_EQ(sum.derivative().at(5), (Vector{0, 0}));
  sum.add(2, TimeSeries::resolve([](double t) { return Vector{t, t * t}; }, 3, 1e-12, "u"));
  EXPECT_NEAR(sum.at(1.5)[0], 4, 1e-13);
  EXPECT_NEAR(sum.at(1.5)[1], 6.5, 1e-13);
}

TEST(TimeSeries, sums_with_what_took_more_points)
{
  const auto slow = [](double t) { return Vector{t * t}; };
  const auto fast = [](double t) { return Vector{std::sin(12 * t)}; };
  TimeSeries few = TimeSeries::resolve(slow, 2, 1e-11, "u"),
             many = TimeSeries::resolve(fast, 2, 1e-11, "u");
  ASSERT_LT(few.n_points(), many.n_points());
  TimeSeries sum = few;
  sum.add(1, many);
  many.add(1, few);
  for (const double t : {0., .3, 1.7})
  {
    EXPECT_NEAR(sum.at(t)[0], t * t + std::sin(12 * t), 1e-10);
    EXPECT_NEAR(many.at(t)[0], sum.at(t)[0], 1e-12);
  }
}

TEST(TimeSeries, refuses_what_is_not_smooth)
{
  EXPECT_THROW(
      TimeSeries::resolve([](double t) { return Vector{std::abs(t - .3)}; }, 1, 1e-11, "u"),
      InputError);
  EXPECT_THROW(
      TimeSeries::resolve([](double t) { return Vector{std::sin(200 * t)}; }, 1, 1e-11, "u"),
      InputError);
}
