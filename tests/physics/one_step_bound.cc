// Jha & Lipton 2018, doi:10.1137/17M1112236: constants and a priori bounds.

#include "physics/one_step_bound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace plumbline;
using namespace plumbline::physics;

namespace
{
  const std::vector<PowerTerm> constant = {{1, 0}}, decaying = {{1, 0}, {-1, 1}};
} // namespace

// Section 6: C_bar = 1.19, horizon 1/10, 1.5 of 718 microseconds; printed are .0193 and 7.976
TEST(OneStepBound, the_example_of_section_6_has_a_misprint)
{
  const DoubleWell law(2, decaying, .595, 1, .1);
  EXPECT_NEAR(law.c_bar(), 1.19, 1e-14);
  const double time = 1.5 / 718, other = 1.5e-6 * 1400;
  EXPECT_NEAR(growth_factor(lipschitz_constant(law), time), .00930, 5e-6);
  EXPECT_NEAR(section_six_factor(1.19, .1, time), 7.89, 5e-3);
  EXPECT_NEAR(growth_factor(lipschitz_constant(law), other), .00943, 5e-6);
  EXPECT_NEAR(section_six_factor(1.19, .1, other), 7.99, 5e-3);
  // what is printed as C₂ belongs to C₁ = .0094
  const double ratio =
      section_six_factor(1.19, .1, time) / growth_factor(lipschitz_constant(law), time);
  EXPECT_NEAR(7.976 / ratio, .0094, 5e-5);
}

TEST(OneStepBound, steps_are_limited_by_the_lipschitz_constant)
{
  const DoubleWell law(2, decaying, 1, 1, .2);
  EXPECT_NEAR(lipschitz_constant(law), 300, 1e-10); // (41)
  EXPECT_NEAR(printed_step_limit(law), .02, 1e-15); // (53)
  EXPECT_NEAR(step_limit(law, .5), 2 / 300., 1e-15);
  EXPECT_EQ(one_step_bound(300, .5, 1.01 * step_limit(law, .5), 3, 1),
            std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isfinite(one_step_bound(300, .5, .99 * step_limit(law, .5), 3, 1)));
}

// (52), summed step by step
TEST(OneStepBound, is_the_sum_of_its_recursion)
{
  for (const double lipschitz : {.3, 7.})
    for (const double theta : {0., .5, .8})
    {
      constexpr double step = .02, truncation = .7;
      constexpr int n = 40;
      const double rate = std::max(1., lipschitz) * step;
      double error = 0;
      for (int k = 0; k < n; ++k)
        error = ((1 + (1 - theta) * rate) * error + 2 * truncation * step) / (1 - theta * rate);
      EXPECT_NEAR(one_step_bound(lipschitz, theta, step, n, truncation), error, 1e-11 * error);
    }
}

// (37), (38), (49) by hand, (63) in closed form: J_½ of J = 1 - t is dim (1/(dim-½) - 1/(dim+½))
TEST(OneStepBound, constants_are_those_of_the_paper)
{
  const SolutionNorms norms{2, 3, 5, 7, 11};
  EXPECT_DOUBLE_EQ(c_t(norms), 2.5);
  EXPECT_DOUBLE_EQ(c_t_of_trapezoidal(norms), 8 / 12.);
  const DoubleWell law(2, decaying, 1, 1, .2);
  EXPECT_NEAR(c_s(law, norms, 1, 4), 2 * std::sqrt(2.) * (.04 * 11 + 8 * 7), 1e-12);
  EXPECT_NEAR(c_s(law, norms, .5, 4), 2 * std::pow(2., .25) * (.04 * 11 + 8 * 7), 1e-12);
  for (const int dim : {1, 2, 3})
  {
    const DoubleWell one(dim, decaying, 1, 1, .2), flat(dim, constant, 1, 1, .2);
    EXPECT_NEAR(energy_constant(one, 4), 8 * one.c1() * dim * (1 / (dim - .5) - 1 / (dim + .5)),
                1e-12);
    EXPECT_NEAR(energy_constant(flat, 4), 8 * one.c1() * dim / (dim - .5), 1e-12);
  }
  const double root = 3 + 2 * energy_constant(law, 4) / std::pow(.2, 1.5) + .5;
  EXPECT_NEAR(energy_bound(law, 4, 9, 2, .5), root * root, 1e-12 * root * root);
}
