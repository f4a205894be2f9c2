// Radial potentials of kernels against closed forms, series and nested integrals.
#include "physics/radial_potential.h"

#include "physics/gauss.h"
#include "physics/outer_potential.h"
#include "physics/regular_potential.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace plumbline;
  using physics::Kernel;
  using physics::RadialPotential;
  using physics::Structure;

  constexpr double horizon = .7, lowest = -8;

  Kernel<2> powers(physics::RadialProfile::Powers terms)
  {
    return {Structure::scalar, std::move(terms), horizon, 1};
  }

  /// f of Σ c (r/δ)^k: of D² f = C / 16 with f = O((1-q)^4), D = d/dq (q d/dq), by Euler's powers
  /// q^(k/2+2) and the solutions 1, q, ln q, q ln q of D² f = 0.
  long double closed_f(const physics::RadialProfile::Powers &terms, long double q)
  {
    long double sum = 0;
    for (const auto &[coefficient, k] : terms)
    {
      const long double m = k / 2.L + 2;
      const long double p = coefficient / ((k + 2.L) * (k + 2) * (k + 4) * (k + 4));
      const long double c = -p * m * (m - 1) * (m - 1), d = -p * m * m * (m - 1);
      const long double b = -p * m - c - d, a = -p - b;
      sum += p * std::pow(q, m) + a + b * q + (c + d * q) * std::log(q);
    }
    return sum;
  }
} // namespace

TEST(RadialPotential, is_that_of_closed_forms)
{
  for (const physics::RadialProfile::Powers &terms :
       {physics::RadialProfile::Powers{{1, 0}}, physics::RadialProfile::Powers{{1, 0}, {-1, 1}},
        physics::RadialProfile::Powers{{1, -1}}, physics::RadialProfile::Powers{{2, 1}, {-1, 4}}})
  {
    const RadialPotential potential(powers(terms), lowest);
    for (double rho = lowest; rho <= RadialPotential::highest_rho; rho += .0137)
    {
      if (std::abs(rho) < .2)
        continue; // the closed form cancels
      const auto expected = static_cast<double>(closed_f(terms, 1 - rho));
      EXPECT_NEAR(potential.f(rho), expected,
                  (rho < .9 ? 1e-14 : 1e-13) * std::abs(expected) + 1e-16)
          << rho;
    }
  }
}

TEST(RadialPotential, of_the_constant_kernel_is_its_series_at_the_circle)
{
  const RadialPotential potential(powers({{1, 0}}), lowest);
  for (const double rho : {-.25, -.1, -.01, -1e-6, 1e-9, 1e-3, .02, .25})
  {
    double f = 0, integral = 0; // 16 f = Σ_{j >= 4} (j-3)/(2j(j-1)) ρ^j
    for (int j = 60; j >= 4; --j)
    {
      const double coefficient = (j - 3.) / (32. * j * (j - 1)) * std::pow(rho, j);
      f += coefficient;
      integral += coefficient * rho / (j + 1);
    }
    EXPECT_NEAR(potential.f(rho), f, 1e-14 * std::abs(f)) << rho;
    EXPECT_NEAR(potential.g(rho), integral / (2 * (1 - rho)), 1e-14 * std::abs(integral)) << rho;
  }
}

TEST(RadialPotential, of_any_profile_solves_its_equation)
{
  // D w = C/16, D f = w: twice f(q) = ∫_q^1 ln(s/q) (…)(s) ds
  const auto profile =
      physics::RadialProfile::smooth([](double t) { return std::exp(-3 * t * t); }, true);
  const Kernel<2> kernel(Structure::scalar, profile, horizon, 2);
  const RadialPotential potential(kernel, lowest);
  const auto &rule = physics::gauss(40);
  const auto invert = [&](const std::function<double(double)> &of, double q)
  {
    double sum = 0;
    for (unsigned int i = 0; i < rule.size(); ++i)
    {
      const double s = q + (1 - q) * rule.point(i)[0];
      sum += (1 - q) * rule.weight(i) * std::log(s / q) * of(s);
    }
    return sum;
  };
  const auto c = [&](double s) { return kernel.radial(horizon * std::sqrt(s)) / 16; };
  for (const double q : {.2, .5, .9, 1.3, 4.})
  {
    const double f = invert([&](double s) { return invert(c, s); }, q);
    EXPECT_NEAR(potential.f(1 - q), f, 1e-12 * std::abs(f)) << q;
    double integral = 0; // of f from q to 1
    for (unsigned int i = 0; i < rule.size(); ++i)
      integral += (1 - q) * rule.weight(i) * potential.f((1 - q) * (1 - rule.point(i)[0]));
    EXPECT_NEAR(potential.g(1 - q), integral / (2 * q), 1e-13 * std::abs(integral)) << q;
  }
}

TEST(RadialPotential, of_bond_tensors_is_that_of_closed_forms)
{
  // δ⁴ [z_a z_b A + δ² δ_ab B] with Δ² of it = ξ_a ξ_b γ: A is the part that changes with the
  // direction, q A/2 + B half the trace
  struct Case
  {
    physics::RadialProfile::Powers terms; // t² γ
    long double (*A)(long double q, long double log), (*B)(long double q, long double log);
  };
  const Case cases[] = {
      {{{1, 2}},
       [](long double q, long double) { return std::pow(1 - q, 4) / (384 * q * q); },
       [](long double q, long double log)
       {
         return -q * q * q / 2304 + q * q / 192 + q / 64 - 11.L / 576 - 1 / (768 * q) -
                (q / 64 + 1.L / 96) * log;
       }},
      {{{1, -1}},
       [](long double q, long double)
       { return -std::sqrt(q) / 15 + q / 48 + 1.L / 16 - 1 / (48 * q) + 1 / (240 * q * q); },
       [](long double q, long double log)
       {
         return 4 * std::pow(q, 1.5L) / 45 - q * q / 96 - q / 32 - 13.L / 288 - 1 / (480 * q) -
                (q / 16 + 1.L / 48) * log;
       }},
      {{{1, 0}, {-1, 1}},
       [](long double q, long double log)
       {
         return q * log / 96 + q / 576 - std::pow(q, 1.5L) / 105 + 1.L / 96 - 1 / (320 * q) +
                1 / (2016 * q * q);
       },
       [](long double q, long double log)
       {
         return -q * q * log / 192 + q * q / 144 + 4 * std::pow(q, 2.5L) / 1575 - q / 576 -
                3.L / 400 - 1 / (4032 * q) - (q / 96 + 1.L / 320) * log;
       }}};
  for (const Case &one : cases)
  {
    const physics::PotentialTables<2> potential({Structure::tensor, one.terms, horizon, 1}, lowest);
    const auto &rule = physics::gauss(40);
    for (double rho = lowest; rho <= RadialPotential::highest_rho; rho += .0137)
    {
      const auto found = potential.f(rho), divergence = potential.g(rho);
      const double q = 1 - rho;
      double integral[2] = {}; // of f, of s f from q to 1
      for (unsigned int i = 0; i < rule.size(); ++i)
      {
        const double at = rho * rule.point(i)[0];
        const auto f = potential.f(at);
        integral[0] += rho * rule.weight(i) * f[0];
        integral[1] += rho * rule.weight(i) * (1 - at) * f[1];
      }
      const double rounding = rho < .9 ? 1e-14 : 1e-12;
      EXPECT_NEAR(divergence[0], integral[0] / (2 * q), rounding * std::abs(divergence[0])) << rho;
      EXPECT_NEAR(divergence[1], integral[1] / (2 * q * q), rounding * std::abs(divergence[1]))
          << rho;
      if (std::abs(rho) < .2)
        continue; // the closed form cancels
      const long double exact_q = 1 - static_cast<long double>(rho), log = std::log(exact_q);
      const long double A = one.A(exact_q, log), trace = exact_q * A / 2 + one.B(exact_q, log);
      EXPECT_NEAR(found[0], static_cast<double>(trace),
                  rounding * std::abs(static_cast<double>(trace)) + 1e-16)
          << rho;
      EXPECT_NEAR(found[1], static_cast<double>(A),
                  rounding * std::abs(static_cast<double>(A)) + 1e-16)
          << rho;
    }
  }
}

TEST(RegularPotential, of_a_gaussian_is_its_series)
{
  // D² q^(k+2) = (k+1)² (k+2)² q^k, and 2 q g = ∫_0^q f
  const double rate = 1.5;
  const auto profile =
      physics::RadialProfile::smooth([&](double t) { return std::exp(-rate * t * t); }, true);
  const Kernel<2> kernel(Structure::scalar, profile, horizon, 2);
  const double farthest = 2.2;
  const physics::RegularPotential potential(kernel, farthest);
  double largest = potential.f(farthest * farthest);
  for (double q = 0; q <= farthest * farthest; q += .0713)
  {
    long double f = 0, g = 0, term = 2. / 16;
    for (int k = 0; k < 80; ++k)
    {
      const long double part =
          term * std::pow(static_cast<long double>(q), k + 2) / (std::pow((k + 1.L) * (k + 2), 2));
      f += part;
      g += part / (2 * (k + 3));
      term *= -rate / (k + 1);
    }
    EXPECT_NEAR(potential.f(q), static_cast<double>(f), 1e-14 * largest) << q;
    EXPECT_NEAR(potential.g(q), static_cast<double>(g), 1e-14 * largest) << q;
  }
}

TEST(RegularPotential, is_of_smooth_kernels_alone)
{
  const auto can_have = [](const physics::RadialProfile &profile, double farthest) {
    return physics::RegularPotential::can_have({Structure::scalar, profile, horizon, 1}, farthest);
  };
  const auto gaussian = [](double rate) {
    return physics::RadialProfile::smooth([=](double t) { return std::exp(-rate * t * t); }, true);
  };
  EXPECT_TRUE(can_have(gaussian(4), 2));
  EXPECT_FALSE(can_have(gaussian(400), 2));
  EXPECT_TRUE(can_have({{1, 0}, {-1, 2}}, 2));
  EXPECT_FALSE(can_have({{1, 0}, {-1, 1}}, 2));
  EXPECT_FALSE(
      can_have(physics::RadialProfile::smooth([](double t) { return std::exp(-t); }, false), 2));
}

TEST(OuterPotential, is_the_whole_without_what_the_circle_cuts_off)
{
  // both solve their equations with the same kernel beyond the circle
  const physics::RadialProfile::Powers terms = {{.7, -1}, {1, 0}, {-2, 1}, {.5, 2}};
  for (const Structure structure : {Structure::scalar, Structure::tensor})
  {
    const Kernel<2> kernel(structure, terms, horizon, 2);
    const physics::OuterPotential outside(kernel);
    const bool is_tensor = structure == Structure::tensor;
    for (const double q : {1., 1.1, 1.7, 3., 4.5})
    {
      double trace = 0, rest = 0;
      for (const auto &[coefficient, k] : terms)
      {
        const double c = 2 * coefficient;
        trace +=
            (is_tensor ? .5 : 1) * c * std::pow(q, k / 2. + 2) / std::pow((k + 2.) * (k + 4), 2);
        rest += k == 0 ? c * q * std::log(q) / 96
                       : c * std::pow(q, k / 2. + 1) / (k * (k + 2.) * (k + 4) * (k + 6));
      }
      const auto found = outside.f(q);
      if (!is_tensor)
      {
        const double cut = RadialPotential(kernel, lowest).f(1 - q);
        EXPECT_NEAR(static_cast<double>(found[0]), trace - cut, 1e-14 * std::abs(trace)) << q;
        continue;
      }
      const auto cut = physics::PotentialTables<2>(kernel, lowest).f(1 - q);
      EXPECT_NEAR(static_cast<double>(found[0]), trace - cut[0], 1e-14 * std::abs(trace)) << q;
      EXPECT_NEAR(static_cast<double>(found[1]), rest - cut[1], 1e-14 * std::abs(rest)) << q;
    }
  }
}

TEST(OuterPotential, of_functions_is_that_of_their_moments)
{
  const auto profile =
      physics::RadialProfile::smooth([](double t) { return std::exp(-3 * t * t); }, true);
  const Kernel<2> kernel(Structure::scalar, profile, horizon, 2);
  const auto outside = physics::OuterPotential::of_smooth(kernel);
  const physics::RegularPotential whole(kernel, 2.2);
  const RadialPotential cut(kernel, lowest);
  for (const double q : {1., 1.1, 1.7, 3., 4.5})
    EXPECT_NEAR(static_cast<double>(outside.f(q)[0]), whole.f(q) - cut.f(1 - q), 1e-14) << q;
}

TEST(OuterPotential, has_its_integral)
{
  const auto &rule = physics::gauss(40);
  const Kernel<2> kernel(Structure::tensor, {{1, -1}, {.3, 0}}, horizon, 2);
  const physics::OuterPotential outside(kernel);
  for (const double q : {1.2, 2., 4.5})
  {
    long double trace = 0, rest = 0;
    for (unsigned int i = 0; i < rule.size(); ++i)
    {
      const double s = 1 + (q - 1) * rule.point(i)[0];
      trace += rule.weight(i) * (q - 1) * outside.f(s)[0];
      rest += rule.weight(i) * (q - 1) * s * outside.f(s)[1];
    }
    EXPECT_NEAR(static_cast<double>(outside.integral(q)[0] - trace), 0, 1e-15);
    EXPECT_NEAR(static_cast<double>(outside.integral(q)[1] - rest), 0, 1e-15);
  }
}
