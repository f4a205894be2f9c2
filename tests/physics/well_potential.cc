#include "physics/well_potential.h"

#include "base/error.h"
#include "physics/double_well.h"
#include "physics/expression.h"
#include "physics/taylor_expression.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::physics;

namespace
{
  WellPotential potential(const std::string &text)
  {
    return {"Material/potential", text};
  }

  std::string refusal(const std::string &text)
  {
    try
    {
      potential(text);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "accepted";
  }

  void expect_refused(const std::string &text, const std::string &reason)
  {
    const std::string message = refusal(text);
    EXPECT_EQ(message.rfind("Material/potential = '" + text + "'", 0), 0u) << message;
    EXPECT_NE(message.find(reason), std::string::npos) << message;
  }

  constexpr double places[] = {0, 1e-9, .01, .3, .999, 1, 1.7, 4, 12.3, 35, 1e3, 1e7};
} // namespace

TEST(TaylorExpression, reads_as_other_expressions_do)
{
  for (const std::string text :
       {"1 - 2*r - 3", "-r^2", "2^-r", "2^r^2", "8/2/r", "8/2*r", "-r*-2", "1e-3*r + .5",
        "sqrt(r)*exp(-r)", "ln(1 + r)", "atan(r) + tanh(r)", "sinh(r)/cosh(r)", "sin(pi*r)",
        "cos(r)^2", "r^2.5", "(1 + r)^(-r)", "+r - (2 - r)"})
  {
    const TaylorExpression taylor("f", text);
    std::string in_x = text;
    for (std::size_t at = 0; (at = in_x.find('r', at)) != std::string::npos; ++at)
      if (in_x.compare(at, 2, "rt") != 0)
        in_x[at] = 'x';
    const Expression expression("f", in_x);
    for (const double r : {.3, 1.7})
      EXPECT_NEAR(taylor(r)[0], expression(Point<2>(r, 0)), 1e-14) << text;
  }
}

TEST(TaylorExpression, has_the_derivatives)
{
  for (const std::string text :
       {"exp(-2*r)", "ln(1 + r)", "sqrt(1 + r)", "sin(r)", "cos(r)", "atan(3*r)", "sinh(r)",
        "cosh(r)", "tanh(2*r)", "r^3", "r^2.5", "(1 + r)^r", "r/(1 + r)^2", "1/(2 - r)"})
  {
    const TaylorExpression f("f", text);
    constexpr double r = .7, step = 1e-5;
    const Taylor low = f(r - step), here = f(r), high = f(r + step);
    for (unsigned int n = 0; n < 3; ++n)
      EXPECT_NEAR((n + 1) * here[n + 1], (high[n] - low[n]) / (2 * step),
                  1e-8 * (1 + std::abs(here[n + 1])))
          << text << ' ' << n;
  }
  const Taylor square = TaylorExpression("f", "r^2")(0);
  EXPECT_EQ(square, (Taylor{0, 0, 1, 0}));
}

TEST(TaylorExpression, refuses_other_text)
{
  for (const auto &[text, reason] :
       {std::pair{"1 - exp(-r", "a bracket is not closed"},
        std::pair{"1 - x", "at character 5: there is an unknown name 'x'"},
        std::pair{"2 r", "an operator is missing before 'r'"}, std::pair{"", "is missing"},
        std::pair{"exp r", "'(' is missing after exp"}, std::pair{"r > 1", "before '>'"}})
    expect_refused(text, reason);
}

TEST(WellPotential, is_the_same_by_an_expression)
{
  const WellPotential exponential, same = potential("1 - exp(-r)");
  EXPECT_TRUE(exponential.is_exponential());
  EXPECT_FALSE(same.is_exponential());
  for (const double s : places)
  {
    EXPECT_NEAR(same.value(s), exponential.value(s), 1e-13);
    EXPECT_NEAR(same.value(s), exponential.value(s), 1e-13 * s);
    EXPECT_NEAR(same.derivative(s), exponential.derivative(s), 1e-13);
    EXPECT_NEAR(same.tangent(s), exponential.tangent(s), 1e-13);
  }
  EXPECT_NEAR(same.softening(), exponential.softening(), 1e-12);
  for (unsigned int n = 0; n < 3; ++n)
    EXPECT_NEAR(same.largest_derivatives()[n], exponential.largest_derivatives()[n], 1e-12);
}

// f = 3 · 2r/(1 + 2r): φ = s/(1+s), φ' + 2sφ'' = (1 - 3s)/(1+s)³
TEST(WellPotential, has_the_derived_values_of_a_rational_one)
{
  const WellPotential f = potential("3*2*r/(1 + 2*r)");
  EXPECT_NEAR(f.limit(), 3, 1e-14);
  EXPECT_NEAR(f.slope(), 6, 1e-14);
  EXPECT_NEAR(f.softening(), 1. / 3, 1e-12);
  for (const double s : places)
  {
    const double t = 1 + s;
    EXPECT_NEAR(f.value(s), s / t, 1e-13);
    EXPECT_NEAR(f.derivative(s) * std::sqrt(t), std::pow(t, -1.5), 1e-13);
    EXPECT_NEAR(f.tangent(s), (1 - 3 * s) / (t * t * t), 1e-13);
  }
  // F = x²/(1+x²): F' = 2x/(1+x²)² is largest at x² = 1/3; F'' = 2 at 0; F''' = -24x(1-x²)/(1+x²)⁴,
  // largest where 1 - 10x² + 5x⁴ = 0
  const double square = 1 - std::sqrt(.8), x = std::sqrt(square);
  EXPECT_NEAR(f.largest_derivatives()[0], 9 / (8 * std::sqrt(3.)), 1e-12);
  EXPECT_NEAR(f.largest_derivatives()[1], 2, 1e-12);
  EXPECT_NEAR(f.largest_derivatives()[2], 24 * x * (1 - square) / std::pow(1 + square, 4), 1e-12);
  EXPECT_NEAR(f.value(1e30), 1, 1e-13);
  EXPECT_EQ(f.value(INFINITY), 1);
  EXPECT_TRUE(std::isnan(f.value(NAN)));
}

// in any units: 8e3 (1 - 1/(1 + 1e9 r)²) has p = 1.6e13, φ = 1 - 1/(1 + s/2)² and r̄² = 2/5
TEST(WellPotential, gives_the_constants_of_the_law)
{
  const WellPotential f = potential("8e3*(1 - 1/(1 + 1e9*r)^2)");
  EXPECT_NEAR(f.softening(), .4, 1e-12);
  const DoubleWell law(2, std::vector<PowerTerm>{{1, 0}}, 2 * f.limit(), f.slope() / f.limit(), .1,
                       f);
  EXPECT_NEAR(law.stiffness(), 3.2e13, 1e-12 * 3.2e13);
  EXPECT_NEAR(law.toughness(), 4 / M_PI * 1.6e4 / 3, 1e-12 * 1.6e4);
  EXPECT_NEAR(law.modulus(), 1.6e13 / 3, 1e-12 * 1.6e13);
  EXPECT_NEAR(law.softening_strain(.1), std::sqrt(.2 / (1e9 * .1)), 1e-12 * 4.5e-5);
  for (const double s : {1e-12, 1e-9, 3e-9, 1e-7})
  {
    const double t = 1 + 1e9 * s;
    EXPECT_NEAR(law.potential(s), 1.6e4 * (1 - 1 / (t * t)), 1e-12 * 1.6e4);
    EXPECT_NEAR(law.derivative(s), 3.2e13 / (t * t * t), 1e-12 * 3.2e13);
    EXPECT_NEAR(law.tangent(s), 3.2e13 * (1 - 5e9 * s) / std::pow(t, 4), 1e-12 * 3.2e13);
  }
}

TEST(WellPotential, refuses_what_has_no_two_wells)
{
  expect_refused("r", "has no finite limit as r grows");
  expect_refused("ln(1 + r)", "has no finite limit as r grows");
  expect_refused("1 - (1 + r)^(-0.1)", "too slowly");
  expect_refused("exp(-r)", "f' = -1 at r = 0");
  expect_refused("2 - exp(-r)", "f = 1 at r = 0");
  expect_refused("sqrt(r)/(1 + sqrt(r))", "f' = ");
  expect_refused("r*exp(-r)", "f = 0 at r = ");
  expect_refused("r^2/(1 + r^2)", "f' = 0 at r = 0; a double-well potential f is smooth");
  expect_refused("(r + 2*r^2)/(1 + r + 2*r^2)", "f'' = ");
  expect_refused("1 - exp(-r) + 0.001*(1 - exp(-1e3*r))", "f must be smooth on the scale of");
  expect_refused("sinh(r)/cosh(r)", "f = ");
  EXPECT_EQ(refusal("tanh(r)"), "accepted");
  EXPECT_EQ(refusal("2/pi*atan(r)"), "accepted");
}
