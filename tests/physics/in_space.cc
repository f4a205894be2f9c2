// Fields in space as series, and loads of fields against closed forms.
#include "base/control_points.h"
#include "base/error.h"
#include "physics/chebyshev_in_space.h"
#include "physics/load_in_space.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::physics;

namespace
{
  constexpr double horizon = .3;

  std::vector<Point<3>> samples()
  {
    return {{.1, .2, .3}, {.5, .4, .9}, {.8, .7, .2}};
  }

  double wave(const Point<3> &x, unsigned int)
  {
    return std::sin(2 * x[0] + x[1] - 3 * x[2]);
  }
} // namespace

TEST(ChebyshevInSpace, applies_functionals_of_each_axis_in_their_order)
{
  const auto f = [](const Point<3> &x, unsigned int c)
  { return c == 0 ? std::exp(x[0]) * x[1] * std::cos(2 * x[2]) : x[0] + 10 * x[1] + 100 * x[2]; };
  const auto series = ChebyshevInSpace::resolve(f, 2, {0, -1, 2}, {1, 1, 2.5});
  ASSERT_TRUE(series.has_value());
  // a value, a difference, and a sum of two values
  const AxisFunctionals functionals = {
      {{{{.3, 1}}, {{.9, 1}, {.1, -1}}}, {{{-.5, 1}}}, {{{2.1, 1}, {2.4, 1}}}}};
  const auto values = series->apply(0, functionals);
  const double along_z = std::cos(4.2) + std::cos(4.8);
  ASSERT_EQ(values.size(), 2u); // x fastest
  EXPECT_NEAR(values[0], std::exp(.3) * -.5 * along_z, 1e-13);
  EXPECT_NEAR(values[1], (std::exp(.9) - std::exp(.1)) * -.5 * along_z, 1e-13);
  EXPECT_NEAR(series->apply(1, functionals)[0], 2 * .3 - 2 * 5 + 100 * 4.5, 1e-11);
}

TEST(ChebyshevInSpace, is_not_there_for_a_field_with_a_kink)
{
  EXPECT_FALSE(ChebyshevInSpace::resolve([](const Point<3> &x, unsigned int)
                                         { return std::abs(x[2] - .4); },
                                         1, {0, 0, 0}, {1, 1, 1})
                   .has_value());
}

TEST(ChebyshevInSpace, is_not_there_for_a_field_without_values_in_a_part)
{
  EXPECT_FALSE(ChebyshevInSpace::resolve([](const Point<3> &x, unsigned int)
                                         { return std::sqrt(x[1] - .3); },
                                         1, {0, 0, 0}, {1, 1, 1})
                   .has_value());
}

TEST(ChebyshevInSpace, does_not_miss_what_lies_between_its_points)
{
  const double place = base::control_points(10)[2], width = .015;
  const auto f = [&](const Point<3> &x, unsigned int)
  { return x[0] + std::exp(-(x - Point<3>(place, place, place)).norm_square() / (width * width)); };
  // without its peak it would be resolved by two terms; with it no 65 points do
  EXPECT_FALSE(ChebyshevInSpace::resolve(f, 1, {0, 0, 0}, {1, 1, 1}).has_value());
}

TEST(LoadInSpace, of_a_plane_wave_is_the_symbol_of_the_constant_kernel_times_it)
{
  const Kernel<3> kernel(Structure::scalar, kernel_type("constant").profile, horizon, 2.5);
  const LoadInSpace load(kernel, wave, samples());
  const double k = std::sqrt(14.), s = k * horizon;
  const double symbol =
      4 * M_PI * 2.5 * (std::pow(horizon, 3) / 3 - (std::sin(s) - s * std::cos(s)) / (k * k * k));
  for (const Point<3> &x : {Point<3>(.25, .75, .1), Point<3>(0, 0, 0), Point<3>(.9, .05, .6)})
    EXPECT_NEAR(load(x, 0), symbol * wave(x, 0), 1e-13);
}

TEST(LoadInSpace, of_polynomials_is_exact_for_bond_tensors)
{
  const auto kernel =
      Kernel<3>::with_bulk_modulus(kernel_type("bond-tensor").profile, horizon, 1.7);
  // u = (x z, y², x²): L u_a = -Σ_b ∫C_ab (quadratic part of u_b), whatever the place
  const LoadInSpace load(
      kernel,
      [](const Point<3> &x, unsigned int c) {
        return c == 0 ? x[0] * x[2] : c == 1 ? x[1] * x[1] : x[0] * x[0];
      },
      samples());
  for (unsigned int a = 0; a < 3; ++a)
  {
    const double exact = -(kernel.moment({1, 0, 1}, a, 0) + kernel.moment({0, 2, 0}, a, 1) +
                           kernel.moment({2, 0, 0}, a, 2));
    EXPECT_NEAR(load({.3, .8, -.2}, a), exact, 1e-13) << a;
  }
}

TEST(LoadInSpace, says_where_a_field_has_none)
{
  const Kernel<3> kernel(Structure::scalar, kernel_type("constant").profile, horizon, 1);
  EXPECT_THROW(
      LoadInSpace(
          kernel, [](const Point<3> &x, unsigned int) { return x[0] > .45 ? 1. : 0.; }, samples()),
      NumericalError);
}
