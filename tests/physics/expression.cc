// Functions that expressions have besides muParser's own.

#include "physics/expression.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using physics::Expression;

TEST(Weierstrass, is_a_sum_of_waves_twice_as_short_each)
{
  const Expression u("u", "weierstrass(x, 0.5, 2)");
  for (const double x : {0., .1, -.37, 2.3})
    EXPECT_NEAR(u({x, 0}),
                std::cos(2 * M_PI * x) + std::cos(4 * M_PI * x + 1.3) / std::sqrt(2) +
                    std::cos(8 * M_PI * x + 5.2) / 2,
                1e-13);
}

TEST(Weierstrass, means_are_those_over_the_width)
{
  const double width = .3;
  const Expression u("u", "weierstrass(x, 0.25, 4)"),
      mean("u", "weierstrass_mean(x, 0.25, 4, width)", {{"width", width}}),
      of_point("u", "weierstrass_mean(x, 0.25, 4, 0)");
  constexpr int n = 20000;
  for (const double x : {0., .23})
  {
    double sum = 0;
    for (int i = 0; i < n; ++i)
      sum += u({x + width * ((i + .5) / n - .5), 0}) / n;
    EXPECT_NEAR(mean({x, 0}), sum, 1e-6);
    EXPECT_EQ(of_point({x, 0}), u({x, 0}));
  }
}

TEST(Weierstrass, refuses_exponents_and_numbers_of_waves_that_are_none)
{
  for (const std::string text :
       {"weierstrass(x, 0, 3)", "weierstrass(x, -1, 3)", "weierstrass(x, 1, 2.5)",
        "weierstrass(x, 1, 31)", "weierstrass(x, 1, -1)"})
    EXPECT_THROW((void)Expression("u", text)({.1, 0}), InputError) << text;
  EXPECT_THROW(Expression("u", "weierstrass(x, 1)"), InputError);
}

TEST(Expression, knows_whether_it_may_be_made_of_pieces)
{
  for (const char *text : {"x > 0.5 ? 1 : 0", "(x > 0.5)*y", "abs(x)", "max(x, y)", "min(x, 0)",
                           "1, sign(y)", "rint(4*x)", "x == y", "3*abs(x)+1"})
    EXPECT_TRUE(Expression("k", text).is_piecewise()) << text;
  for (const char *text : {"sin(3*x)*cos(2*y)", "exp(-x^2), y", "1", "minimum*x", "signal + y"})
    EXPECT_FALSE(Expression("k", text, {{"minimum", 1}, {"signal", 2}}).is_piecewise()) << text;
  physics::Names names;
  names.fields["R"] = [](const dealii::Point<2> &) { return 1.; };
  EXPECT_TRUE(Expression("k", "1 + R", names).is_piecewise());
  EXPECT_FALSE(Expression("k", "1 + x", names).is_piecewise());
}

TEST(Expression, is_called_smooth_only_where_it_surely_is)
{
  const physics::Names names{{"delta", .1}};
  for (const char *const text :
       {"1.5 + x", "1 + 0.5*sin(3*x)*cos(2*y)", "exp(-x^2 - y^2)", "2e-3*x + 1", "1/(1 + x)",
        "ln(2 + x*delta)", "-x^ 3 + tanh(40*(y - .5))", "7"})
    EXPECT_TRUE(Expression("a", text, names).is_smooth()) << text;
  for (const char *const text :
       {"x < 0.5 ? 1 : 2", "abs(x)", "sign(x - .5)", "x^0.5", "x^1.5", "x^(1/2)", "x^y", "sqrt(x)",
        "min(x, y)", "rint(x)", "weierstrass(x, 0.5, 2)", "atan2(y, x)", "1 + (x > 0.5)"})
    EXPECT_FALSE(Expression("a", text, names).is_smooth()) << text;
  physics::Names random;
  random.fields["R"] = [](const dealii::Point<2> &x) { return x[0]; };
  EXPECT_FALSE(Expression("a", "1 + R", random).is_smooth());
}

// Between neighbouring numbers of double precision around 5e6, 1e-9 apart, the sine of the
// difference would have steps; with an origin it has none, wherever that is.
TEST(Expression, is_smooth_however_far_from_the_origin)
{
  physics::Names names;
  names.origin = {5411930, -448250};
  const Expression near("u", "sin(3*x)*cos(2*y)"),
      far("u", "sin(3*(x - 5411930))*cos(2*(y + 448250))", names),
      jump("u", "x > 5411930.5", names);
  double largest = 0;
  for (int i = 0; i < 200; ++i)
  {
    const dealii::Point<2> x(.1 + i * 7.3e-12, .7 - i * 1.1e-11);
    largest = std::max(largest, std::abs(far(x) - near(x)));
  }
  EXPECT_LT(largest, 2e-15);
  EXPECT_EQ(jump({.5 - 1e-8, 0}), 0);
  EXPECT_EQ(jump({.5 + 1e-8, 0}), 1);
  try
  {
    (void)Expression("u", "1/(x - 5411930.5)", names)({.5, 0});
    ADD_FAILURE() << "no message";
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("(5411930.5, -448250)"), std::string::npos)
        << error.what();
  }
}
