#include "physics/radial_profile.h"

#include "base/error.h"
#include "physics/kernel.h"
#include "physics/load.h"
#include "physics/waves.h"

#include <boost/math/special_functions/gamma.hpp>

#include <gtest/gtest.h>

using namespace plumbline;
using namespace plumbline::physics;

namespace
{
  RadialProfile gaussian(double width)
  {
    return kernel_type("gaussian").make({{}, 0, width, {}});
  }
  RadialProfile exponential(double width)
  {
    return kernel_type("exponential").make({{}, 0, width, {}});
  }

  /// So many equal intervals of a function.
  RadialProfile sampled(unsigned int n, const std::function<double(double)> &f)
  {
    std::vector<std::array<double, 2>> rows;
    for (unsigned int i = 0; i <= n; ++i)
      rows.push_back({static_cast<double>(i) / n, f(static_cast<double>(i) / n)});
    return RadialProfile::table(rows);
  }

  const RadialProfile ragged = RadialProfile::table({{0, 2}, {.3, 1.5}, {.5, .2}, {1, .1}});
} // namespace

TEST(RadialProfile, moments_of_functions_are_incomplete_gamma_functions)
{
  for (const double width : {.05, .2, .5, 1., 3., 40.})
    for (const int n : {0, 1, 3, 5, 8})
      for (const double from : {0., .3})
      {
        const auto lower = [](double a, double x) { return boost::math::tgamma_lower(a, x); };
        const double s = width, to_n = std::pow(s, n + 1), a = .5 * (n + 1);
        // of [0, 1], whose rounding an integral over its tail keeps
        const double bell = .5 * to_n * lower(a, 1 / (s * s)), decay = to_n * lower(n + 1, 1 / s);
        EXPECT_NEAR(gaussian(s).moment(n, from), bell - .5 * to_n * lower(a, from * from / (s * s)),
                    1e-13 * bell)
            << s << ' ' << n;
        EXPECT_NEAR(exponential(s).moment(n, from), decay - to_n * lower(n + 1, from / s),
                    1e-13 * decay)
            << s << ' ' << n;
      }
}

TEST(RadialProfile, pieces_and_parts_of_a_table_make_it_up)
{
  EXPECT_EQ(ragged.breaks(), (std::vector<double>{.3, .5}));
  EXPECT_DOUBLE_EQ(ragged(.3), 1.5);
  EXPECT_DOUBLE_EQ(ragged(.4), .85);
  EXPECT_NEAR(ragged(1.5), 0, 1e-15); // on by the last line
  for (const double t : {.01, .29, .31, .49, .6, 1.})
  {
    double sum = 0, piece = 0;
    for (const auto &part : ragged.parts())
      if (t < part.end || part.end == 1)
        sum += part.profile(t / part.end);
    for (const auto &one : ragged.pieces())
      if (piece == 0 && t <= one.end)
        piece = one.profile(t);
    EXPECT_NEAR(sum, ragged(t), 1e-15) << t;
    EXPECT_DOUBLE_EQ(piece, ragged(t)) << t;
    EXPECT_NEAR(ragged.over_t()(t), ragged(t) / t, 1e-15 / t);
    EXPECT_NEAR(gaussian(.4).over_t()(t), gaussian(.4)(t) / t, 1e-15 / t);
  }
  EXPECT_NEAR(ragged.moment(1, .4),
              .1 * (.85 * .45 + .2 * .45) / 2 - .1 * .1 * .65 / 12 +
                  .5 * (.2 * .5 + 4 * .15 * .75 + .1 * 1) / 6,
              1e-3); // trapezoid, Simpson
  EXPECT_NEAR(ragged.moment(3), ragged.over_t().moment(4), 1e-15);
  EXPECT_NEAR(gaussian(.4).moment(3), gaussian(.4).over_t().moment(4), 1e-15);
}

TEST(RadialProfile, of_a_table_is_the_power_that_it_is_sampled_from_or_tends_to_it)
{
  const RadialProfile line = sampled(20, [](double t) { return 1 - t; });
  EXPECT_TRUE(line.breaks().empty());
  for (const int n : {0, 1, 3, 5})
    EXPECT_NEAR(line.moment(n), RadialProfile({{1, 0}, {-1, 1}}).moment(n), 1e-15);
  const RadialProfile exact({{1, 0}, {-2, 1}, {1, 2}});
  double before = 0;
  for (const unsigned int n : {5u, 10u, 20u, 40u})
  {
    const auto table = sampled(n, [&](double t) { return t > 0 ? exact(t) : 1; });
    const double error = std::abs(table.moment(3) - exact.moment(3));
    EXPECT_EQ(table.breaks().size(), n - 1);
    if (n > 5)
    {
      EXPECT_NEAR(before / error, 4, .2);
    }
    before = error;
  }
}

TEST(RadialProfile, degree_and_order_say_how_it_is_integrated)
{
  EXPECT_EQ(RadialProfile({{1, -1}, {2, 3}}).degree(), 4u);
  EXPECT_EQ(RadialProfile({{1, -1}, {2, 3}}).lowest_exponent(), -1);
  EXPECT_EQ(gaussian(.4).over_t().lowest_exponent(), -1);
  EXPECT_TRUE(gaussian(.4).is_even(false));
  EXPECT_FALSE(gaussian(.4).is_even(true));
  EXPECT_FALSE(exponential(.4).is_even(false));
  EXPECT_LT(gaussian(.4).degree(.1), gaussian(.4).degree(.5));
  EXPECT_LT(gaussian(.4).degree(.5), gaussian(.1).degree(.5));
  EXPECT_LE(gaussian(10).degree(), 12u);
}

TEST(RadialProfile, loads_and_waves_of_a_table_are_sums_of_those_of_its_parts)
{
  const Kernel<2> kernel(Structure::scalar, ragged, .3, 2);
  const Expression u("u", "sin(3*x)*exp(y)");
  const Point<2> x(.2, .7);
  double load = 0, wave = 0, moment = 0;
  for (const Kernel<2> &part : kernel.parts())
  {
    load += ManufacturedLoad(part, u)(x, 0);
    wave += exact_wave(part, {}, Polarisation::scalar, 20).squared;
    moment += part.moment({2, 2});
  }
  EXPECT_NEAR(kernel.moment({2, 2}), moment, 1e-15);
  EXPECT_NEAR(ManufacturedLoad(kernel, u)(x, 0), load, 1e-13 * std::abs(load));
  EXPECT_NEAR(exact_wave(kernel, {}, Polarisation::scalar, 20).squared, wave, 1e-13 * wave);
}

TEST(RadialProfile, refuses_what_is_no_profile)
{
  const auto message = [](const auto &make) -> std::string
  {
    try
    {
      make();
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "accepted";
  };
  const auto table = [&](std::vector<std::array<double, 2>> rows)
  { return message([&] { RadialProfile::table(rows); }); };
  const auto has = [](const std::string &text, const std::string &part)
  { EXPECT_NE(text.find(part), std::string::npos) << text; };
  has(table({{0, 1}}), "has 1 rows; give 2 to 1000");
  has(table({{.1, 1}, {1, 0}}), "row 1 of the table of the radial profile has t = 0.1");
  has(table({{0, 1}, {.5, 1}, {.5, 0}, {1, 0}}), "must increase from 0 to 1");
  has(table({{0, 1}, {.9, 0}}), "the last t must be 1");
  has(table({{0, 1}, {1, NAN}}), "both must be finite");
  for (const double width : {0., -1., .04, static_cast<double>(NAN)})
    has(message([&] { gaussian(width); }), "must be 0.05 or more");
  has(message([] { RadialProfile::smooth([](double t) { return std::sin(500 * t); }, false); }),
      "varies so fast");
  has(message([] { RadialProfile::smooth([](double t) { return 1 / (t - .5); }, false); }),
      "must be finite");
}
