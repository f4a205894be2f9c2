#include "physics/double_well.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace plumbline;
using namespace plumbline::physics;

namespace
{
  const std::vector<PowerTerm> constant = {{1, 0}}, decaying = {{1, 0}, {-1, 1}};

  DoubleWell well(int dim, const std::vector<PowerTerm> &influence)
  {
    return {dim, influence, 1, 1, .2};
  }

  /// max over r > 0 of |the n-th derivative of f(r²)|, by differences of f on a fine grid.
  double largest_derivative(const DoubleWell &law, int n)
  {
    constexpr double step = 2e-3;
    double largest = 0;
    for (int i = 0; i < 4000; ++i)
    {
      const double x = 1e-3 * i;
      const auto f = [&](double r) { return law.potential(r * r); };
      const double value =
          n == 1   ? (f(x + step) - f(x - step)) / (2 * step)
          : n == 2 ? (f(x + step) - 2 * f(x) + f(x - step)) / (step * step)
                   : (f(x + 2 * step) - 2 * f(x + step) + 2 * f(x - step) - f(x - 2 * step)) /
                         (2 * step * step * step);
      largest = std::max(largest, std::abs(value));
    }
    return largest;
  }
} // namespace

// Jha & Lipton 2018, doi:10.1137/17M1112236, (70)-(72)
TEST(DoubleWell, constants_are_the_largest_derivatives_of_the_bond_law)
{
  for (const double beta : {1., 2.5})
  {
    const DoubleWell law(2, constant, 3, beta, .2);
    EXPECT_NEAR(law.c1(), largest_derivative(law, 1), 2e-5 * law.c1());
    EXPECT_NEAR(law.c2(), largest_derivative(law, 2), 2e-5 * law.c2());
    EXPECT_NEAR(law.c3(), largest_derivative(law, 3), 5e-5 * law.c3());
  }
  const DoubleWell law = well(2, constant);
  EXPECT_NEAR(law.c1(), .857764, 5e-7);
  EXPECT_DOUBLE_EQ(law.c2(), 2);
  EXPECT_NEAR(law.c3(), 3.903566, 5e-7);
}

// ibid., (35), (41)
TEST(DoubleWell, lipschitz_constants_are_those_of_the_paper)
{
  EXPECT_NEAR(well(2, decaying).c_bar(), 2, 1e-14);
  EXPECT_NEAR(well(2, constant).c_bar(), 4, 1e-14);
  EXPECT_NEAR(well(3, decaying).c_bar(), 1, 1e-14);
  EXPECT_NEAR(well(3, constant).c_bar(), 3, 1e-14);
  EXPECT_EQ(well(1, constant).c_bar(), std::numeric_limits<double>::infinity());
  EXPECT_NEAR(well(1, {{1, 1}}).c_bar(), 2, 1e-14);
}

TEST(DoubleWell, long_waves_have_the_speeds_of_its_moduli)
{
  EXPECT_NEAR(std::pow(well(2, decaying).wave_speeds().transverse, 2), .0416667, 5e-8);
  EXPECT_NEAR(std::pow(well(2, constant).wave_speeds().transverse, 2), .166667, 5e-7);
  const auto speeds = DoubleWell(2, constant, 2, 3, .1).wave_speeds(4);
  EXPECT_NEAR(std::pow(speeds.transverse, 2), 6 * .166667 / 4, 1e-6);
  EXPECT_NEAR(std::pow(speeds.longitudinal / speeds.transverse, 2), 3, 1e-13);
}

TEST(DoubleWell, moduli_are_those_of_the_kernel_of_small_strains)
{
  const DoubleWell law(2, {{1, 0}, {-.5, 2}}, 2, 3, .3);
  const LocalLimit limit = law.linear_kernel().limit();
  EXPECT_NEAR(limit.mu, law.modulus(), 1e-14);
  EXPECT_NEAR(limit.lambda, law.modulus(), 1e-14);
}

TEST(DoubleWell, toughness_is_the_energy_of_the_bonds_that_cross_a_line)
{
  EXPECT_NEAR(well(2, decaying).toughness(), .106103, 5e-7);
  EXPECT_NEAR(well(2, constant).toughness(), .424413, 5e-7);
  EXPECT_NEAR(well(3, constant).toughness(), .375, 1e-15);
  // half of all ordered pairs end beyond the line, |cos| r of the starting points each:
  // c / (ε³π) ∫ J |ξ_2| dξ, by midpoints
  const DoubleWell law(2, {{1, 0}, {-.5, 2}}, 2, 3, .3);
  constexpr int n = 600;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
    {
      const double x = (2. * i + 1 - n) / n * .3, y = (2. * j + 1 - n) / n * .3;
      if (std::hypot(x, y) < .3)
        sum += law.influence(std::hypot(x, y)) * std::abs(y) * std::pow(.6 / n, 2);
    }
  EXPECT_NEAR(law.toughness(), 2 * sum / (.027 * M_PI), 1e-3 * law.toughness());
}

TEST(DoubleWell, potential_keeps_its_digits_at_small_strains)
{
  const DoubleWell law(2, constant, 2, 3, .3);
  EXPECT_NEAR(law.potential(1e-12) / 6e-12, 1, 1e-11);
  EXPECT_NEAR(law.derivative(.1), (law.potential(.1 + 1e-6) - law.potential(.1 - 1e-6)) / 2e-6,
              1e-9);
  // beyond the softening strain the force falls
  const double r = .2, strain = law.softening_strain(r);
  const auto force = [&](double s) { return law.derivative(r * s * s) * s; };
  EXPECT_GT(force(strain), force(.99 * strain));
  EXPECT_GT(force(strain), force(1.01 * strain));
}

TEST(DoubleWell, refuses_what_is_no_law)
{
  const auto message = [](double c, double beta, double horizon, std::vector<PowerTerm> influence,
                          int dim = 2) -> std::string
  {
    try
    {
      DoubleWell(dim, std::move(influence), c, beta, horizon);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(message(0, 1, 1, constant).find("c = 0 must be positive"), std::string::npos);
  EXPECT_NE(message(1, -1, 1, constant).find("beta = -1 must be positive"), std::string::npos);
  EXPECT_NE(message(1, 1, NAN, constant).find("horizon = nan"), std::string::npos);
  EXPECT_NE(message(1, 1, 1, {{1, -1}}).find("must be bounded"), std::string::npos);
  EXPECT_NE(message(1, 1, 1, {{1, 0}, {-2, 1}}).find("must not be negative"), std::string::npos);
  EXPECT_NE(message(1, 1, 1, {{0, 0}}).find("vanishes"), std::string::npos);
  EXPECT_NE(message(1, 1, 1, constant, 4).find("choose 1, 2 or 3"), std::string::npos);
  EXPECT_EQ(message(1, 1, 1, constant), "accepted");
  EXPECT_THROW(well(2, constant).wave_speeds(-1), InputError);
}
