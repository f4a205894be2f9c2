// Integrals over lines of potentials without a horizon against a rule for their formulas.
#include "reference/mesh/power_potential.h"

#include "physics/gauss.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace plumbline;
  using reference::PowerPotential;
  using reference::Vector2;

  constexpr double horizon = .7;

  /// Half the trace or all of scalar kernels, and what H has, of Ψ or its divergence form.
  std::array<double, 2> formula(const physics::Kernel<2> &kernel, double r, bool for_divergence)
  {
    std::array<double, 2> result{};
    const bool is_tensor = kernel.n_components() > 1;
    for (const auto &[coefficient, k] : kernel.profile().powers())
    {
      const double c = kernel.constant() * coefficient * std::pow(horizon, -k);
      result[0] += (is_tensor ? .5 : 1) * c * std::pow(r, k + 4) /
                   (std::pow((k + 2.) * (k + 4), 2) * (for_divergence ? k + 6 : 1));
      if (is_tensor && k != 0)
        result[1] += c * std::pow(r, k + 2) /
                     (k * (k + 2.) * (k + 4) * (k + 6) * (for_divergence ? k + 6 : 1));
      else if (is_tensor)
        result[1] += c / 48 * r * r *
                     (for_divergence ? std::log(r / horizon) / 6 - 1. / 36 : std::log(r / horizon));
    }
    return result;
  }

  /// By a rule that crowds towards the foot of 0 on the line.
  PowerPotential::Entries by_rule(const physics::Kernel<2> &kernel, const Vector2 &e, double from,
                                  double to, double h, double a, double b, bool for_divergence)
  {
    PowerPotential::Entries sum{};
    const auto &rule = physics::gauss(100);
    const auto add = [&](double first, double last) // towards the first
    {
      for (unsigned int i = 0; i < rule.size(); ++i)
      {
        const double s = rule.point(i)[0], x = first + (last - first) * s * s * s;
        const double weight = rule.weight(i) * 3 * s * s * (last - first) * (a + b * x);
        const double z0 = x * e[0] - h * e[1], z1 = x * e[1] + h * e[0];
        const double r = std::max(std::hypot(x, h), 1e-100); // Ψ(0) = 0
        const auto value = formula(kernel, r, for_divergence);
        sum[0] += weight * value[0];
        sum[1] += weight * value[1] * .5 * (z0 * z0 - z1 * z1);
        sum[2] += weight * value[1] * z0 * z1;
      }
    };
    const double foot = std::min(std::max(0., from), to);
    add(foot, to);
    for (double &entry : sum)
      entry = -entry;
    add(foot, from);
    for (double &entry : sum)
      entry = -entry;
    return sum;
  }
} // namespace

TEST(PowerPotential, HasTheIntegralsOfItsFormula)
{
  using physics::Structure;
  const std::vector<physics::RadialProfile::Powers> profiles = {
      {{1, -1}}, {{1, 0}, {-1, 1}}, {{1, 2}}, {{.3, -1}, {2, 0}, {1, 1}, {-1, 2}, {.5, 3}}};
  const Vector2 e = reference::Point<2>(.6, .8);
  for (const Structure structure : {Structure::scalar, Structure::tensor})
    for (const auto &profile : profiles)
    {
      const physics::Kernel<2> kernel(structure, profile, horizon, 2);
      const PowerPotential potential(kernel);
      for (const double h : {0., 1e-9, .1, -.3})
        for (const std::array<double, 2> ends :
             {std::array<double, 2>{0, .2}, {-.2, 0}, {.1, .25}, {-.3, .1}, {-.8, -.7}, {-.1, .1}})
          for (const bool for_divergence : {false, true})
          {
            const auto found =
                potential.integrate(e, ends[0], ends[1] - ends[0], h, 1.3, -.8, for_divergence);
            const auto expected = by_rule(kernel, e, ends[0], ends[1], h, 1.3, -.8, for_divergence);
            double size = 0;
            for (const double entry : expected)
              size = std::max(size, std::abs(entry));
            for (unsigned int i = 0; i < 3; ++i)
              EXPECT_NEAR(found[i], expected[i], 2e-14 * size)
                  << h << " " << ends[0] << " " << ends[1] << " " << for_divergence;
          }
    }
}

TEST(PowerPotential, IsLessWhatIsTakenOff)
{
  const physics::Kernel<2> kernel(physics::Structure::tensor, {{1, -1}}, horizon, 2);
  const PowerPotential all(kernel);
  PowerPotential less(kernel);
  const std::array<double, 2> trace = {.3, -.2}, rest = {.5, .7};
  less.subtract(trace, rest);
  const Vector2 e = reference::Point<2>(.6, .8);
  const double from = .1, length = .15, h = .2, square = horizon * horizon;
  const auto &rule = physics::gauss(6);
  for (const bool for_divergence : {false, true})
  {
    const auto before = all.integrate(e, from, length, h, 1.3, -.8, for_divergence),
               after = less.integrate(e, from, length, h, 1.3, -.8, for_divergence);
    PowerPotential::Entries expected{};
    for (unsigned int i = 0; i < rule.size(); ++i)
    {
      const double x = from + length * rule.point(i)[0], q = (x * x + h * h) / square;
      const double weight = length * rule.weight(i) * (1.3 - .8 * x);
      const double z0 = x * e[0] - h * e[1], z1 = x * e[1] + h * e[0];
      // G of div (z G) is Ψ over its degree and 2
      const auto value = [&](const std::array<double, 2> &of, double degree) {
        return for_divergence ? of[0] / (degree + 2) + of[1] * q / (degree + 4) : of[0] + of[1] * q;
      };
      expected[0] += weight * square * square * value(trace, 0);
      expected[1] += weight * square * value(rest, 2) * .5 * (z0 * z0 - z1 * z1);
      expected[2] += weight * square * value(rest, 2) * z0 * z1;
    }
    for (unsigned int i = 0; i < 3; ++i)
      EXPECT_NEAR(before[i] - after[i], expected[i], 1e-15);
  }
}
