// The covariance of grains that overlap: closed forms, and drawn samples.
#include "uq/boolean_covariance.h"
#include "base/error.h"
#include "physics/gauss.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::uq;

namespace
{
  const std::array<double, 2> grain{12, 7.5}; // [µm]

  /// Overlap of two disks of radius R, r apart, as share of one.
  double disks(double radius, double r)
  {
    const double half = r / (2 * radius);
    return half >= 1 ? 0 : 2 / M_PI * (std::acos(half) - half * std::sqrt(1 - half * half));
  }

  /// The mean over many angles, of disks after the map to one.
  double by_many_angles(const std::array<double, 2> &axes, double r)
  {
    constexpr int n_angles = 200'000;
    double sum = 0;
    for (int k = 0; k < n_angles; ++k)
    {
      const double theta = M_PI / 2 * (k + .5) / n_angles;
      sum += disks(1, r * std::hypot(std::cos(theta) / axes[0], std::sin(theta) / axes[1]));
    }
    return sum / n_angles;
  }
} // namespace

TEST(SetCovariance, of_disks_has_a_closed_form)
{
  for (const double r : {0., 1e-6, .5, 3., 5.9, 6., 7.})
    EXPECT_NEAR(set_covariance({3, 3}, r), disks(3, r), 1e-14);
}

TEST(SetCovariance, of_ellipses_is_the_mean_over_angles)
{
  for (const auto axes : {grain, std::array{7.5, 12.}, std::array{10., 1.}})
  {
    const double b = std::min(axes[0], axes[1]), a = std::max(axes[0], axes[1]);
    for (const double r : {0., .1 * b, b, 1.9 * b, a + b, 1.99 * a, 2 * a, 3 * a})
      EXPECT_NEAR(set_covariance(axes, r), by_many_angles(axes, r), 1e-12) << axes[0] << ' ' << r;
    for (const double r : {2 * b * (1 - 1e-4), 2 * b, 2 * b * (1 + 1e-4)})
      EXPECT_NEAR(set_covariance(axes, r), by_many_angles(axes, r), 1e-9) << axes[0] << ' ' << r;
  }
}

TEST(SetCovariance, integrates_to_the_area)
{
  const auto &rule = physics::gauss(200);
  double sum = 0;
  for (const auto &[from, to] : {std::pair{0., 15.}, std::pair{15., 24.}})
    for (unsigned int q = 0; q < rule.size(); ++q)
    {
      const double r = from + (to - from) * rule.point(q)[0];
      sum += rule.weight(q) * (to - from) * 2 * M_PI * r * set_covariance(grain, r);
    }
  EXPECT_NEAR(sum / (M_PI * 12 * 7.5), 1, 1e-9);
}

TEST(BooleanCovariance, has_the_values_of_a_prototype)
{
  const auto c = boolean_covariance({grain, .2, true});
  EXPECT_NEAR(c(0, 0), .2 * .8, 1e-15);
  const double normalised[4] = {.700, .433, .213, .069}; // at 4, 8, 12, 16 µm
  for (int k = 0; k < 4; ++k)
    EXPECT_NEAR(c(0, 4 * (k + 1)) / c(0, 0), normalised[k], 6e-4);
  EXPECT_DOUBLE_EQ(c(3, 4), c(5, 0));
  EXPECT_EQ(c(17, 17), 0);
}

TEST(BooleanCovariance, is_that_of_drawn_samples_within_their_standard_error)
{
  constexpr int n_samples = 300;
  const Grid grid{{{0, 0}, {200, 200}}, {50, 50}};
  for (const double fraction : {.2, .8})
  {
    const EllipseModel model{grain, fraction, true};
    const auto c = boolean_covariance(model);
    const std::array<std::array<int, 2>, 6> lags{{{0, 0}, {1, 0}, {0, 2}, {2, 2}, {-3, 2}, {6, 0}}};
    std::array<double, 6> sum{}, squares{};
    for (int sample = 0; sample < n_samples; ++sample)
    {
      const auto values = Ellipses::draw(model, grid.box, 21, sample).at_nodes(grid);
      for (std::size_t l = 0; l < lags.size(); ++l)
      {
        double product = 0;
        int n = 0;
        for (int j = 0; j + lags[l][1] < 50; ++j)
          for (int i = 3; i + lags[l][0] < 50; ++i, ++n)
            product += (values[j * 50 + i] - fraction) *
                       (values[(j + lags[l][1]) * 50 + i + lags[l][0]] - fraction);
        sum[l] += product / n;
        squares[l] += product / n * product / n;
      }
    }
    for (std::size_t l = 0; l < lags.size(); ++l)
    {
      const double mean = sum[l] / n_samples;
      const double error = std::sqrt((squares[l] / n_samples - mean * mean) / (n_samples - 1));
      EXPECT_LT(error, .02 * fraction * (1 - fraction)); // it can tell
      EXPECT_LT(std::abs(mean - c(4 * lags[l][0], 4 * lags[l][1])), 4 * error)
          << fraction << ' ' << l;
    }
  }
}

TEST(BooleanCovariance, refuses_grains_that_do_not_overlap)
{
  EXPECT_THROW(boolean_covariance({grain, .2, false}), InputError);
  EXPECT_THROW(boolean_covariance({grain, 1., true}), InputError);
}
