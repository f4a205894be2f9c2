#include "physics/load.h"

#include "base/error.h"
#include "physics/chebyshev.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace plumbline;
using namespace plumbline::physics;

namespace
{
  constexpr double horizon = .4;

  Kernel<2> linear_decay()
  {
    return Kernel<2>::with_diffusion(kernel_type("linear-decay").profile, horizon, .5);
  }

  /// Compare at random points of the unit square.
  template <class Exact>
  void expect_load(const Kernel<2> &kernel, const std::string &u, const Exact &exact,
                   unsigned int component = 0)
  {
    const ManufacturedLoad load(kernel, Expression("Problem/solution", u));
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < 20; ++i)
    {
      const Point<2> x(uniform(random), uniform(random));
      const double value = exact(x[0], x[1]);
      EXPECT_NEAR(load(x, component), value, 1e-13 * std::max(1., std::abs(value)))
          << u << " at " << x;
    }
  }
} // namespace

// Closed forms of Yang & Yin, section 5, for the linear-decay kernel.
TEST(ManufacturedLoad, agrees_with_closed_forms_for_polynomials)
{
  expect_load(linear_decay(), "x*(1-x)/2 + y*(1-y)/2", [](double, double) { return 1; });
  expect_load(linear_decay(), "x^3 + 2*y^2", [](double x, double) { return -(3 * x + 2); });
  expect_load(
      linear_decay(), "x^3*y^2 + y^4",
      [](double x, double y)
      { return -(x * x * x + 3 * x * y * y + 6 * y * y) - 5 * horizon * horizon / 14 * (1 + x); });
}

TEST(ManufacturedLoad, agrees_with_the_closed_form_for_the_bond_tensor)
{
  const double kappa = 1.5;
  const auto kernel =
      Kernel<2>::with_bulk_modulus(kernel_type("bond-tensor").profile, horizon, kappa);
  const std::string v = "x*(1-x)/2 + y*(1-y)/2";
  for (unsigned int c = 0; c < 2; ++c)
    expect_load(
        kernel, v + "," + v, [&](double, double) { return 12 * kappa / 5; }, c);
}

// -∫ (u(x+z) - u(x)) over the ball = [πδ² - 2πδ J1(kδ)/k] u for u = sin(k·x).
TEST(ManufacturedLoad, agrees_with_bessel_functions_for_waves)
{
  const auto kernel = Kernel<2>::with_diffusion(kernel_type("constant").profile, horizon, 1);
  const double k = std::hypot(5, 3);
  const double symbol =
      kernel.constant() *
      (M_PI * horizon * horizon - 2 * M_PI * horizon * std::cyl_bessel_j(1, k * horizon) / k);
  expect_load(kernel, "sin(5*x + 3*y)",
              [&](double x, double y) { return symbol * std::sin(5 * x + 3 * y); });
}

// The seventh power of |x| is just smooth enough: its rings converge like n^-8, so that a rule that
// stops early is far off while two of them agree already.
TEST(ManufacturedLoad, settles_to_the_accuracy_that_it_claims)
{
  const auto kernel = Kernel<2>::with_diffusion(kernel_type("constant").profile, horizon, 1);
  const ManufacturedLoad load(kernel, Expression("Problem/solution", "abs(x - 0.5)^7"));
  // ∫ |ξ_1|^7 = δ^9/9 ∫ |cos|^7, and the latter is 2 √π Γ(4) / Γ(9/2)
  const double exact = -kernel.constant() * std::pow(horizon, 9) / 9 * 2 * std::sqrt(M_PI) *
                       std::tgamma(4) / std::tgamma(4.5);
  EXPECT_NEAR(load(Point<2>(.5, .3), 0), exact, 1e-13 * std::abs(exact));
}

// u = f(x) cos y, f a layer: across the ball cos y integrates to 2 sin(√(δ² - ξ²)) cos y, and with
// ξ = δ sin t what is left is periodic in t, for which equidistant points are exact to rounding.
TEST(ManufacturedLoad, of_a_layer_is_right_to_twelve_digits)
{
  const auto kernel = Kernel<2>::with_diffusion(kernel_type("constant").profile, horizon, 1);
  for (const double a : {2., 5., 10., 20.})
  {
    const ManufacturedLoad load(
        kernel, Expression("Problem/solution", "atan(" + std::to_string(a) + "*(x-.43))*cos(y)"));
    const auto f = [a](double x) { return std::atan(a * (x - .43)); };
    for (const double x : {.05, .3, .43, .45, .5, .83})
    {
      constexpr int n = 4000;
      double sum = 0;
      for (int k = 0; k < n; ++k)
      {
        const double t = 2 * M_PI * (k + .5) / n, across = horizon * std::cos(t);
        sum += f(x + horizon * std::sin(t)) * 2 * std::sin(across) * across * M_PI / n;
      }
      const double exact =
          -kernel.constant() * std::cos(.6) * (sum - M_PI * horizon * horizon * f(x));
      EXPECT_NEAR(load(Point<2>(x, .6), 0), exact, 1e-12 * std::max(1., std::abs(exact)))
          << a << ' ' << x;
    }
  }
}

TEST(ManufacturedLoad, takes_the_mean_of_the_coefficients_at_both_ends)
{
  // a = 1 + x, u = x²: -∫ C (a + ξ_1/2) (2 x ξ_1 + ξ_1²) = -(1 + 2 x) ∫ C ξ_1²
  const ManufacturedLoad load(
      linear_decay(), Expression("Problem/solution", "x^2"),
      Coefficient(Expression("Kernel/coefficient", "1 + x"), Mean::arithmetic));
  for (const double x : {0., .3, .9})
    EXPECT_NEAR(load(Point<2>(x, .2), 0), -(1 + 2 * x) * linear_decay().moment({2, 0}), 1e-13);
}

TEST(Coefficient, is_refused_where_it_is_not_positive)
{
  const Coefficient a(Expression("Kernel/coefficient", "x"), Mean::arithmetic);
  EXPECT_EQ(a.at(Point<2>(.5, 0)), .5);
  EXPECT_THROW(a.at(Point<2>(0, 0)), InputError);
  EXPECT_THROW(a.at(Point<2>(-.5, 0)), InputError);
}

TEST(OperatorScale, is_the_integral_of_the_kernel_without_its_sign)
{
  const double disc = M_PI * horizon * horizon;
  const auto of = [&](const std::vector<PowerTerm> &profile)
  { return operator_scale(Kernel<2>(Structure::scalar, profile, horizon, -3)); };
  EXPECT_NEAR(of({{1, 0}}), 3 * disc, 1e-14);
  EXPECT_NEAR(of({{1, -1}}), 2 * 3 * disc, 1e-14);      // 2π ∫ (δ/r) r dr = 2 π δ²
  EXPECT_NEAR(of({{-1, 1}}), 2. / 3 * 3 * disc, 1e-14); // 2π ∫ (r/δ) r dr
}

TEST(ManufacturedLoad, refuses_a_field_that_is_not_smooth)
{
  const ManufacturedLoad load(linear_decay(), Expression("Problem/solution", "sign(x - 0.51)"));
  EXPECT_THROW(load(Point<2>(.5, .5), 0), NumericalError);
}

TEST(ManufacturedLoad, refuses_one_component_for_a_tensor)
{
  const auto kernel = Kernel<2>::with_bulk_modulus(kernel_type("bond-tensor").profile, horizon, 1);
  EXPECT_THROW(ManufacturedLoad(kernel, Expression("Problem/solution", "x")), InputError);
}

TEST(Expression, knows_x_y_pi_and_constants)
{
  const Expression f("key", "sin(pi*x) + delta, x^2 * max(y, 0)", {{"delta", .25}});
  ASSERT_EQ(f.n_components(), 2u);
  EXPECT_DOUBLE_EQ(f(Point<2>(.5, 2), 0), 1.25);
  EXPECT_DOUBLE_EQ(f(Point<2>(.5, 2), 1), .5);
  const Expression copy = f;
  EXPECT_DOUBLE_EQ(copy(Point<2>(1, 3), 1), 3);
}

TEST(Expression, reports_what_does_not_parse_and_what_is_not_finite)
{
  try
  {
    Expression("Problem/load", "x +* y");
    FAIL();
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("Problem/load = 'x +* y' does not parse"),
              std::string::npos);
  }
  const Expression root("Problem/load", "sqrt(x)");
  try
  {
    (void)root(Point<2>(-1, 2));
    FAIL();
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("at (x, y) = (-1, 2)"), std::string::npos);
  }
}

TEST(ChebyshevField, reproduces_smooth_fields_to_round_off_and_contracts_axis_by_axis)
{
  const auto f = [](const Point<2> &x, unsigned int c)
  { return c == 0 ? std::exp(x[0]) * std::cos(4 * x[1]) : x[0] * x[0] * x[1]; };
  const auto field = ChebyshevField::resolve(f, 2, Point<2>(-1, 0), Point<2>(2, 1));
  ASSERT_TRUE(field);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 50; ++i)
  {
    const Point<2> x(3 * uniform(random) - 1, uniform(random));
    for (unsigned int c = 0; c < 2; ++c)
      EXPECT_NEAR((*field)(x, c), f(x, c), 4e-14);
  }
  const auto a = field->basis(0, .3);
  auto b = field->basis(1, .2);
  const auto more = field->basis(1, .7);
  b.insert(b.end(), more.begin(), more.end());
  const auto values = field->contract(1, a, b);
  ASSERT_EQ(values.size(), 2u);
  EXPECT_NEAR(values[0], .3 * .3 * .2, 1e-14);
  EXPECT_NEAR(values[1], .3 * .3 * .7, 1e-14);
}

TEST(ChebyshevField, asks_for_many_values_across_a_layer_alone)
{
  for (const unsigned int across : {0u, 1u})
  {
    unsigned int n_values = 0;
    const auto f = [&](const Point<2> &x, unsigned int)
    {
      ++n_values;
      return std::atan(5 * (x[across] - .43)) * std::cos(x[1 - across]);
    };
    const auto field = ChebyshevField::resolve(f, 1, Point<2>(), Point<2>(1, 1), 0, {{10, 10}});
    ASSERT_TRUE(field);
    EXPECT_LT(n_values, 6000u); // 129² are 16641
    for (const double x : {.01, .4, .44, .97})
      for (const double y : {.02, .5, .93})
        EXPECT_NEAR((*field)(Point<2>(x, y), 0), f(Point<2>(x, y), 0), 1e-13);
  }
}

TEST(ChebyshevField, does_not_claim_to_resolve_a_kink)
{
  EXPECT_FALSE(ChebyshevField::resolve([](const Point<2> &x, unsigned int)
                                       { return std::abs(x[0] - .3); },
                                       1, Point<2>(), Point<2>(1, 1)));
}

// The operator does not see a constant, but rounding of the field does.
TEST(ManufacturedLoad, settles_on_a_large_constant_down_to_its_round_off)
{
  const std::string wave = "0.01*sin(3*x)*cos(2*y)";
  for (const double small : {.4, .0375})
  {
    const auto kernel = Kernel<2>::with_diffusion(kernel_type("linear-decay").profile, small, .5);
    const ManufacturedLoad plain(kernel, Expression("Problem/solution", wave));
    for (const double offset : {1e4, -1e6})
    {
      const ManufacturedLoad shifted(
          kernel, Expression("Problem/solution", std::to_string(offset) + " + " + wave));
      const double noise = 4e-16 * std::abs(offset) * operator_scale(kernel);
      for (const Point<2> &x : {Point<2>(.99, .99), Point<2>(.2, .7)})
        EXPECT_NEAR(shifted(x, 0), plain(x, 0), noise) << offset << ' ' << small;
    }
  }
  // what is not smooth is refused on a constant too
  const ManufacturedLoad kinked(linear_decay(),
                                Expression("Problem/solution", "1e4 + abs(x - .43)"));
  EXPECT_THROW(kinked(Point<2>(.4, .5), 0), NumericalError);
}
