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

TEST(TimeSeries, takes_all_its_points_where_they_suffice)
{
  // 33 points are off by 2e-3, 65 by round-off
  const auto wave = [](double t) { return std::vector<double>{std::sin(.3 - 12 * t)}; };
  const TimeSeries series = TimeSeries::resolve(wave, 4, 1e-9, "wave", 2);
  EXPECT_EQ(series.n_points(), 65u);
  for (const double t : {.013, 1.7, 2.22, 3.99})
    EXPECT_NEAR(series.at(t)[0], wave(t)[0], 1e-11) << t;
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

// The 17 points of [0, 1] lie up to .098 apart: a pulse between two of them was not there.
TEST(TimeSeries, refuses_a_pulse_between_its_points)
{
  for (const double from : {.1, .155, .41, .8})
    for (const double length : {.045, .02, .008})
    {
      const auto pulse = [=](double t)
      { return Vector{t > from && t < from + length ? 100. : 0.}; };
      EXPECT_EQ(TimeSeries::points(pulse, 1), std::nullopt) << from << ' ' << length;
      const auto smooth = [=](double t)
      { return Vector{std::exp(-std::pow((t - from) / (length / 3), 2))}; };
      EXPECT_EQ(TimeSeries::points(smooth, 1), std::nullopt) << from << ' ' << length;
    }
  EXPECT_EQ(TimeSeries::points([](double t) { return Vector{std::sin(3 * t), 2}; }, 1), 17u);
  EXPECT_EQ(TimeSeries::points([](double t) { return Vector{std::exp(-100 * t * t)}; }, 1), 65u);
}

TEST(TimeSeries, takes_as_many_points_as_are_known_to_be_needed)
{
  // (1 - T_32) / 2 of time: 0 at all of 17 Chebyshev points, 1 half way between them
  const auto hidden = [](double t)
  { return Vector{std::pow(std::sin(16 * std::acos(1 - 2 * t)), 2)}; };
  EXPECT_EQ(TimeSeries::points(hidden, 1), 33u);
  const TimeSeries found = TimeSeries::resolve(hidden, 1, 1e-11, "u", 33);
  EXPECT_NEAR(found.at(.3)[0], hidden(.3)[0], 1e-9);
  // its own control points see it as well
  EXPECT_NEAR(TimeSeries::resolve(hidden, 1, 1e-11, "u").at(.3)[0], hidden(.3)[0], 1e-9);
}
