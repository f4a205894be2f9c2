#include "physics/double_well_stability.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline::physics;

namespace
{
  const std::vector<PowerTerm> constant = {{1, 0}}, decaying = {{1, 0}, {-1, 1}};

  DoubleWell well(int dim, double horizon, const std::vector<PowerTerm> &influence)
  {
    return {dim, influence, 1, 1, horizon};
  }
} // namespace

TEST(WaveSymbol, at_rest_is_that_of_the_linear_operator)
{
  // (4p/ε²)[Cin(kε) - 1 + sinc(kε)] for 1 - r, Cin(kε) for 1, with ε = .1, k = 2π
  const double k = 2 * M_PI;
  EXPECT_NEAR(wave_symbol(well(1, .1, decaying), {}, {k, 0}).xx, 13.0304043, 5e-8);
  EXPECT_NEAR(wave_symbol(well(1, .1, constant), {}, {k, 0}).xx, 38.8346908, 5e-8);
  const auto decay = wave_symbol(well(2, .2, decaying), {}, {k, 0}),
             constants = wave_symbol(well(2, .2, constant), {}, {k, 0});
  EXPECT_NEAR(decay.xx, 4.7235952, 5e-8);
  EXPECT_NEAR(decay.yy, 1.6023949, 5e-8);
  EXPECT_NEAR(constants.xx, 18.4823169, 5e-8);
  EXPECT_NEAR(constants.yy, 6.3259900, 5e-8);
  // it does not depend on the direction
  const auto turned = wave_symbol(well(2, .2, constant), {}, {k * .6, k * .8}).eigenvalues();
  EXPECT_NEAR(turned[0], constants.yy, 1e-11);
  EXPECT_NEAR(turned[1], constants.xx, 1e-11);
}

TEST(WaveSymbol, is_at_most_what_dynamics_needs_for_its_longest_step)
{
  // the largest eigenvalue over all waves: 2.000 / ε² (1 - r, at k → ∞) and 4.529 / ε² (1)
  double largest = 0;
  for (double size = .5; size < 20; size += .05) // kε
  {
    EXPECT_LT(wave_symbol(well(2, 1, decaying), {}, {size, 0}).xx, 2);
    largest = std::max(largest, wave_symbol(well(2, 1, constant), {}, {size, 0}).xx);
  }
  EXPECT_NEAR(largest, 4.529, 5e-4);
  EXPECT_NEAR(wave_symbol(well(2, 1, decaying), {}, {120, 0}).xx, 2, 1e-3);
}

TEST(WaveSymbol, long_waves_see_the_acoustic_tensor)
{
  const DoubleWell law(2, decaying, 2, 3, .2);
  const SymmetricMatrix strain{.7, .4, -.3};
  const double small = 1e-3;
  const auto symbol = wave_symbol(law, strain, {.6 * small, .8 * small}),
             tensor = acoustic_tensor(law, strain, {.6, .8});
  EXPECT_NEAR(symbol.xx / (small * small), tensor.xx, 1e-8);
  EXPECT_NEAR(symbol.xy / (small * small), tensor.xy, 1e-8);
  EXPECT_NEAR(symbol.yy / (small * small), tensor.yy, 1e-8);
  const auto at_rest = acoustic_tensor(law, {}, {1, 0});
  EXPECT_NEAR(at_rest.yy, law.modulus(), 1e-13);
  EXPECT_NEAR(at_rest.xx, 3 * law.modulus(), 1e-13);
}

TEST(WaveSymbol, strained_bonds_let_waves_grow)
{
  // ε = .1, g = 4, J = 1, mode 6
  const double symbol = wave_symbol(well(1, .1, constant), {4, 0, 0}, {12 * M_PI, 0}).xx;
  EXPECT_NEAR(-symbol, 188.08508, 5e-6);
  EXPECT_NEAR(std::sqrt(-symbol), 13.71441, 5e-6);
}

TEST(StabilityThresholds, ellipticity_goes_before_the_local_criterion)
{
  const auto of_constant = stability_thresholds(well(1, .1, constant), {1, 0, 0}),
             of_decaying = stability_thresholds(well(1, .1, decaying), {1, 0, 0});
  EXPECT_NEAR(of_constant.ellipticity, .80695, 5e-6);
  const double x = of_constant.ellipticity; // closed forms
  EXPECT_NEAR((2 * x * x + 3 * x + 3) * std::exp(-x), 3, 1e-9);
  EXPECT_NEAR((1 + 2 * of_constant.local) * std::exp(-of_constant.local), 1, 1e-9);
  EXPECT_NEAR(of_constant.local, 1.25643, 5e-6);
  EXPECT_NEAR(of_decaying.ellipticity, 1.12556, 5e-6);
  EXPECT_NEAR(of_decaying.local, 2.14913, 5e-6);
}

TEST(StabilityThresholds, in_two_dimensions_are_those_of_the_table)
{
  const SymmetricMatrix uniaxial{1, 0, 0}, biaxial{1, 0, 1}, shear{0, 1, 0};
  // a unit of the last digit: the first pair is .9762 and 1.6204, whatever the number of points
  const auto check = [](const std::vector<PowerTerm> &influence, const SymmetricMatrix &direction,
                        double ellipticity, double local)
  {
    const auto found = stability_thresholds(well(2, .2, influence), direction);
    EXPECT_NEAR(found.ellipticity, ellipticity, 1e-3);
    EXPECT_NEAR(found.local, local, 1e-3);
  };
  check(constant, uniaxial, .977, 1.621);
  check(constant, biaxial, .692, .807);
  check(constant, shear, .994, 3.090);
  check(decaying, uniaxial, 1.257, 2.327);
  check(decaying, biaxial, .887, 1.126);
  check(decaying, shear, 1.280, 4.894);
}
