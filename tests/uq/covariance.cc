// Covariances by few numbers: limits, closed forms, refusals.
#include "uq/covariance.h"
#include "base/error.h"
#include "refusal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace plumbline;
using namespace plumbline::uq;

namespace
{
  Covariance make(CovarianceShape shape, double smoothness = .5)
  {
    Covariance covariance;
    covariance.shape = shape;
    covariance.variance = 2.5;
    covariance.length = {.3, .7};
    covariance.smoothness = smoothness;
    return covariance;
  }

  std::string refusal_of(const Covariance &covariance)
  {
    return refusal([&] { check(covariance); });
  }
} // namespace

TEST(Covariance, is_its_variance_at_one_place_and_even)
{
  for (const auto shape : {CovarianceShape::exponential, CovarianceShape::separable_exponential,
                           CovarianceShape::gaussian, CovarianceShape::matern})
  {
    const Covariance c = make(shape, 1.7);
    EXPECT_DOUBLE_EQ(c(0, 0), 2.5);
    EXPECT_EQ(c(.2, -.1), c(-.2, .1));
    EXPECT_LT(c(.2, -.1), 2.5);
    EXPECT_EQ(c(1e6, 0), 0);
  }
}

TEST(Covariance, has_the_closed_forms_of_its_shapes_with_a_length_in_each_direction)
{
  const double dx = .2, dy = -.5, r = std::hypot(dx / .3, dy / .7);
  EXPECT_DOUBLE_EQ(make(CovarianceShape::exponential)(dx, dy), 2.5 * std::exp(-r));
  EXPECT_DOUBLE_EQ(make(CovarianceShape::separable_exponential)(dx, dy),
                   2.5 * std::exp(-.2 / .3 - .5 / .7));
  EXPECT_DOUBLE_EQ(make(CovarianceShape::gaussian)(dx, dy), 2.5 * std::exp(-r * r / 2));
}

TEST(Covariance, of_Matern_has_the_closed_forms_of_half_integer_smoothness)
{
  // Rasmussen & Williams 2006, "Gaussian Processes for Machine Learning", eq. 4.17
  for (const double d : {1e-9, 1e-4, .03, .3, 1., 7.})
  {
    const double r = d / .3, s = std::sqrt(3) * r, t = std::sqrt(5) * r, u = std::sqrt(7) * r;
    const double accuracy = 2.5e-13;
    const auto matern = [d](double nu) { return make(CovarianceShape::matern, nu)(d, 0); };
    EXPECT_NEAR(matern(.5), 2.5 * std::exp(-r), accuracy);
    EXPECT_NEAR(matern(1.5), 2.5 * (1 + s) * std::exp(-s), accuracy);
    EXPECT_NEAR(matern(2.5), 2.5 * (1 + t + t * t / 3) * std::exp(-t), accuracy);
    EXPECT_NEAR(matern(3.5), 2.5 * (1 + u + .4 * u * u + u * u * u / 15) * std::exp(-u), accuracy);
  }
}

TEST(Covariance, of_Matern_tends_to_the_Gaussian_like_one_over_the_smoothness)
{
  const Covariance gaussian = make(CovarianceShape::gaussian);
  const auto distance = [&](double nu)
  { return make(CovarianceShape::matern, nu)(.3, .2) - gaussian(.3, .2); };
  for (const double nu : {50., 200.}) // nothing overflows on the way
    EXPECT_NEAR(distance(nu) / distance(2 * nu), 2, .05);
}

TEST(Covariance, separable_ones_are_products)
{
  for (const auto shape : {CovarianceShape::separable_exponential, CovarianceShape::gaussian})
  {
    const Covariance c = make(shape);
    EXPECT_TRUE(c.is_separable());
    EXPECT_DOUBLE_EQ(c(.2, .3), 2.5 * c.factor(0, .2) * c.factor(1, -.3));
  }
  EXPECT_FALSE(make(CovarianceShape::exponential).is_separable());
  EXPECT_FALSE(make(CovarianceShape::matern).is_separable());
}

TEST(Covariance, refuses_what_is_none_with_the_number_and_the_remedy)
{
  EXPECT_EQ(refusal_of(make(CovarianceShape::matern)), "");
  Covariance c = make(CovarianceShape::matern);
  c.length[1] = 0;
  EXPECT_EQ(refusal_of(c),
            "covariance: correlation length = 0 cannot be used; give lengths > 0, in "
            "the unit of the domain");
  c = make(CovarianceShape::matern, -.5);
  EXPECT_NE(refusal_of(c).find("smoothness = -0.5 cannot be used; give one in (0, 1000]"),
            std::string::npos);
  c.shape = CovarianceShape::exponential; // has none
  EXPECT_EQ(refusal_of(c), "");
  c.variance = -1;
  EXPECT_NE(refusal_of(c).find("variance = -1"), std::string::npos);
  c.variance = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal_of(c).find("variance = nan"), std::string::npos);
}
