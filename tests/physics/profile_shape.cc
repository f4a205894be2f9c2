#include "physics/profile_shape.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::physics;

TEST(ProfileShape, knows_the_extremes_of_powers)
{
  // 1 - 4t + 4t² = (1 - 2t)²: it touches 0 at 1/2 and rises beyond
  const RadialProfile touches{{1, 0}, {-4, 1}, {4, 2}};
  const LeastValue least = least_value(touches);
  EXPECT_NEAR(least.value, 0, least.rounding);
  EXPECT_NEAR(least.t, .5, 1e-7);
  EXPECT_FALSE(is_positive_and_non_increasing(touches, 1));
  EXPECT_TRUE(is_positive_and_non_increasing({{1, 0}, {-1, 1}}, 1));
  EXPECT_FALSE(is_positive_and_non_increasing({{1, 0}, {-1, 1}}, -1));
  EXPECT_TRUE(is_positive_and_non_increasing({{1, 0}}, 1));
  EXPECT_TRUE(is_positive_and_non_increasing({{1, -1}}, 1));
  EXPECT_FALSE(is_positive_and_non_increasing({{1, 0}, {-1.001, 1}}, 1)); // below 0 from .999
  EXPECT_FALSE(is_positive_and_non_increasing({{1, 0}, {.001, 3}}, 1));
  EXPECT_FALSE(is_positive_and_non_increasing({{.01, -1}, {1, 1}}, 1)); // falls up to .1
  // a dip of width 1e-4 that no 1000 samples see: (t - a)² - 1e-10, a = .50005
  const double a = .50005;
  EXPECT_LT(least_value({{a * a - 1e-10, 0}, {-2 * a, 1}, {1, 2}}).value, -.99e-10);
}

TEST(ProfileShape, knows_tables_between_all_samples)
{
  const auto with = [](double dip) {
    return RadialProfile::table({{0, 1}, {.5011, 1}, {.5015, dip}, {.5019, 1}, {1, 0}});
  };
  for (const double dip : {-120., -1e-6, .5, 1.001, 7.})
  {
    EXPECT_FALSE(is_positive_and_non_increasing(with(dip), 1)) << dip;
    EXPECT_NEAR(least_value(with(dip)).value, std::min(dip, 0.), 1e-9);
  }
  EXPECT_TRUE(is_positive_and_non_increasing(with(1), 1));
  EXPECT_TRUE(is_positive_and_non_increasing(
      RadialProfile::table({{0, 1}, {.3, .9}, {.30001, .2}, {1, .2}}), 1));
  EXPECT_FALSE(is_positive_and_non_increasing( // negative at its very end
      RadialProfile::table({{0, 1}, {.999, 1e-3}, {1, -1e-3}}), 1));
}

TEST(ProfileShape, knows_functions_where_they_are_resolved)
{
  const auto gaussian = RadialProfile::smooth([](double t) { return std::exp(-4 * t * t); }, true);
  EXPECT_TRUE(is_positive_and_non_increasing(gaussian, 1));
  EXPECT_NEAR(least_value(gaussian).value, std::exp(-4), 1e-15);
  const auto wave = RadialProfile::smooth([](double t) { return std::cos(20 * t); }, true);
  EXPECT_FALSE(is_positive_and_non_increasing(wave, 1));
  EXPECT_NEAR(least_value(wave).value, -1, 1e-5);
}

// 128 Chebyshev points of [0, 1] lie up to 1/80 apart
TEST(RadialProfile, refuses_a_function_with_a_feature_between_its_points)
{
  for (const double at : {.5062, .71, .2941})
    EXPECT_THROW(
        RadialProfile::smooth(
            [at](double t) { return 1 - std::exp(-(t - at) * (t - at) / (3e-4 * 3e-4)); }, false),
        InputError)
        << at;
}
