// Integrals over lines of potentials that go on beyond the circle, against a rule for their
// formulas.
#include "reference/mesh/whole_potential.h"

#include "physics/gauss.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace plumbline;
  using physics::RadialProfile;
  using physics::Structure;
  using reference::PowerPotential;
  using reference::Vector2;
  using reference::WholePotential;

  constexpr double horizon = .7, farthest = 2.2; // the latter in horizons

  struct Line
  {
    double angle, from, length, h; ///< lengths in horizons
  };

  /// Inside, across the circle once and twice, outside; through 0, near and far.
  const std::vector<Line> lines = {{.3, .1, .3, .05},   {.3, -.2, .3, 0},    {1.1, .4, .3, .2},
                                   {2., -.5, .2, -.6},  {2., .7, .4, .1},    {.7, -1.2, .5, -.3},
                                   {.9, -1, 1.5, .8},   {1.7, -.3, .6, 1.1}, {.1, 1.1, .5, .6},
                                   {2.8, 1.4, .3, 1.2}, {2.8, -1.9, .2, .4}};

  /// What integrals are made of: f of δ⁴ f and δ² H f, or for the divergence what it has for them.
  using Formula = std::function<std::array<double, 2>(double q)>;

  PowerPotential::Entries by_rule(const Formula &formula, const Line &line)
  {
    PowerPotential::Entries sum{};
    const auto &rule = physics::gauss(100);
    const double root = std::sqrt(std::max(0., 1 - line.h * line.h)), to = line.from + line.length;
    const auto add = [&](double first, double last, double sign) // crowding towards the first
    {
      for (unsigned int i = 0; i < rule.size(); ++i)
      {
        const double s = rule.point(i)[0], x = first + (last - first) * s * s * s;
        const double weight = sign * rule.weight(i) * 3 * s * s * (last - first) * horizon;
        const double z0 = (x * std::cos(line.angle) - line.h * std::sin(line.angle)) * horizon,
                     z1 = (x * std::sin(line.angle) + line.h * std::cos(line.angle)) * horizon;
        const auto value = formula(std::max(1e-100, x * x + line.h * line.h));
        sum[0] += weight * std::pow(horizon, 4) * value[0];
        sum[1] += weight * horizon * horizon * value[1] * .5 * (z0 * z0 - z1 * z1);
        sum[2] += weight * horizon * horizon * value[1] * z0 * z1;
      }
    };
    std::vector<double> cuts = {line.from, to};
    for (const double cut : {-root, 0., root})
      if (cut > line.from && cut < to)
        cuts.push_back(cut);
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
    {
      const double middle = .5 * (cuts[k] + cuts[k + 1]);
      add(cuts[k], middle, 1);
      add(cuts[k + 1], middle, -1);
    }
    return sum;
  }

  PowerPotential::Entries found(const WholePotential &potential, const Line &line,
                                bool for_divergence)
  {
    const Vector2 e = dealii::Point<2>(std::cos(line.angle), std::sin(line.angle));
    return potential.integrate(e, line.from * horizon, line.length * horizon, line.h * horizon, 1,
                               0, for_divergence);
  }

  /// The formula but for a + b q (of which the divergence form has its parts over 2 and 4, of
  /// tensors over 4 and 6), which two of the lines give.
  void expect_formula(const WholePotential &potential, const Formula &formula, bool is_tensor,
                      bool for_divergence)
  {
    std::vector<PowerPotential::Entries> rest, constant, linear;
    double size = 0;
    for (const Line &line : lines)
    {
      const auto expected = by_rule(formula, line), is = found(potential, line, for_divergence);
      rest.push_back({});
      for (unsigned int i = 0; i < 3; ++i)
      {
        rest.back()[i] = is[i] - expected[i];
        size = std::max(size, std::abs(expected[i]));
      }
      using Two = std::array<double, 2>;
      constant.push_back(by_rule([](double) { return Two{1, 1}; }, line));
      linear.push_back(by_rule(
          [&](double q) {
            return for_divergence ? Two{q / 2, q * 2 / 3} : Two{q, q};
          },
          line));
    }
    for (unsigned int i = 0; i < (is_tensor ? 3 : 1); ++i)
    {
      const unsigned int from = i == 0 ? 0 : 1; // the rest has one pair for both entries
      const std::size_t k = 0, l = lines.size() - 1;
      const double determinant =
          constant[k][from] * linear[l][from] - constant[l][from] * linear[k][from];
      const double a = (rest[k][from] * linear[l][from] - rest[l][from] * linear[k][from]) /
                       determinant,
                   b = (constant[k][from] * rest[l][from] - constant[l][from] * rest[k][from]) /
                       determinant;
      for (std::size_t j = 0; j < lines.size(); ++j)
        EXPECT_NEAR(rest[j][i], a * constant[j][i] + b * linear[j][i], 1e-13 * size)
            << "line " << j << " entry " << i << (for_divergence ? " divergence" : "");
    }
  }

  double power(double c, int k, double q)
  {
    return c * std::pow(q, k / 2. + 2) / std::pow((k + 2.) * (k + 4), 2);
  }
  double power_of_rest(double c, int k, double q)
  {
    return k == 0 ? c * q * std::log(q) / 96
                  : c * std::pow(q, k / 2. + 1) / (k * (k + 2.) * (k + 4) * (k + 6));
  }
} // namespace

TEST(WholePotential, GoesOnBeyondTheCircleWithoutItsKernel)
{
  const std::vector<RadialProfile::Powers> profiles = {
      {{1, -1}}, {{1, 0}, {-1, 1}}, {{1, 2}}, {{.3, -1}, {2, 0}, {1, 1}, {-1, 2}}};
  for (const Structure structure : {Structure::scalar, Structure::tensor})
    for (const auto &profile : profiles)
    {
      const bool is_tensor = structure == Structure::tensor;
      const physics::Kernel<2> kernel(structure, profile, horizon, 2);
      const WholePotential potential(kernel, farthest * horizon, .3);
      EXPECT_FALSE(potential.is_none_inside());
      const physics::OuterPotential outside(kernel);
      const auto formula = [&](double q)
      {
        if (q > 1)
        {
          const auto value = outside.f(q);
          return std::array<double, 2>{static_cast<double>(value[0]),
                                       static_cast<double>(value[1])};
        }
        std::array<double, 2> sum{};
        for (const auto &[c, k] : profile)
        {
          sum[0] += (is_tensor ? .5 : 1) * power(2 * c, k, q);
          sum[1] += power_of_rest(2 * c, k, q);
        }
        return sum;
      };
      expect_formula(potential, formula, is_tensor, false);
    }
}

TEST(WholePotential, HasADivergenceFormOfItsOwn)
{
  // 2 q g = ∫_0^q f, of the rest 2 q² g = ∫_0^q s f
  for (const Structure structure : {Structure::scalar, Structure::tensor})
  {
    const bool is_tensor = structure == Structure::tensor;
    const physics::Kernel<2> kernel(structure, {{1, -1}}, horizon, 2);
    const WholePotential potential(kernel, farthest * horizon, .3);
    const physics::OuterPotential outside(kernel);
    const auto formula = [&](double q)
    {
      const double t = std::min(q, 1.);
      double trace = (is_tensor ? .5 : 1) * power(2, -1, t) * t / 2.5,
             rest = power_of_rest(2, -1, t) * t * t / 2.5;
      if (q > 1)
      {
        trace += static_cast<double>(outside.integral(q)[0]);
        rest += static_cast<double>(outside.integral(q)[1]);
      }
      return std::array<double, 2>{trace / (2 * q), rest / (2 * q * q)};
    };
    expect_formula(potential, formula, is_tensor, true);
  }
}

TEST(WholePotential, OfAFunctionIsThatOfItsTables)
{
  const auto gaussian = RadialProfile::smooth([](double t) { return std::exp(-2 * t * t); }, true);
  const physics::Kernel<2> kernel(Structure::scalar, gaussian, horizon, 2);
  const WholePotential potential(kernel, farthest * horizon, .3);
  const physics::RegularPotential inside(kernel, 1);
  const auto outside = physics::OuterPotential::of_smooth(kernel);
  expect_formula(
      potential,
      [&](double q) {
        return std::array<double, 2>{q > 1 ? static_cast<double>(outside.f(q)[0]) : inside.f(q), 0};
      },
      false, false);
}

TEST(WholePotential, OfTheConstantKernelIsWhatTheCircleTakesFromAProduct)
{
  const physics::Kernel<2> kernel(Structure::scalar, {{3, 0}}, horizon, 2);
  const WholePotential potential(kernel, farthest * horizon, .3);
  EXPECT_TRUE(potential.is_none_inside());
  EXPECT_NEAR(potential.constant(), 6, 1e-14);
  const physics::RadialPotential cut(kernel, 1 - farthest * farthest);
  for (const Line &line : lines)
    for (const bool for_divergence : {false, true})
    {
      const auto expected = by_rule(
          [&](double q)
          {
            const double value = q < 1 ? 0 : for_divergence ? cut.g(1 - q) : -cut.f(1 - q);
            return std::array<double, 2>{value, 0};
          },
          line);
      EXPECT_NEAR(found(potential, line, for_divergence)[0], expected[0],
                  1e-15 + 1e-13 * std::abs(expected[0]));
    }
}
