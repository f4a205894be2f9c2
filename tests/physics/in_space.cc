// Fields in space as series, and loads of fields against closed forms.
#include "base/control_points.h"
#include "base/error.h"
#include "physics/chebyshev_in_space.h"
#include "physics/dilatation_in_space.h"
#include "physics/load_in_space.h"
#include "physics/waves.h"

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
  const LoadInSpace load(kernel, {}, wave, samples());
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
      kernel, {},
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
  EXPECT_THROW(LoadInSpace(
                   kernel, {}, [](const Point<3> &x, unsigned int) { return x[0] > .45 ? 1. : 0.; },
                   samples()),
               NumericalError);
}

namespace
{
  std::optional<Dilatation<3>> solid(const RadialProfile &profile, const Lame &lame)
  {
    return Dilatation<3>{influence_function<3>(profile, horizon),
                         [lame](const Point<3> &) { return lame; }, false, true};
  }

  const std::vector<RadialProfile> influences = {
      {{1, -1}},
      {{1, 0}},
      {{1, 0}, {-1, 1}},
      {{1, -1}, {-1, 0}},
      RadialProfile::smooth([](double t) { return std::exp(-6 * t * t); }, true)};
} // namespace

TEST(DilatationInSpace, of_1_over_r_has_a_closed_form)
{
  // C = ∇∇Ψ, Ψ = φ ⋆ φ, φ = 3 (1 - r) / π for δ = 1. The integral of φ over a plane at the
  // distance |s| from the origin, P(s) = (1 - |s|)² (1 + 2 |s|), gives Ψ = -(P ⋆ P)' / (2π w):
  // π Ψ = 6/5 - 2 w² + 3/4 w³ + 3/5 w⁴ - 3/10 w⁵ for w < 1
  const auto influence = influence_function<3>({{1, -1}}, 1);
  const DilatationInSpace kernel(influence);
  for (const double w : {1e-6, .1, .5, .9, 1.})
  {
    const double across = -4 + 9. / 4 * w + 12. / 5 * w * w - 3. / 2 * w * w * w,
                 along = -4 + 9. / 2 * w + 36. / 5 * w * w - 6 * w * w * w;
    EXPECT_NEAR(kernel(w).across, across / M_PI, 1e-14) << w;
    EXPECT_NEAR(kernel(w).excess, (along - across) / M_PI, 1e-14) << w;
  }
  // 20 π Ψ = (w - 2)⁴ (2 w² + 4 w - 1) / w beyond
  for (const double w : {1., 1.2, 1.7, 1.99})
  {
    const double d = w - 2, d3 = d * d * d, d4 = d * d3, q = 2 * w + 4 - 1 / w,
                 slope = 2 + 1 / (w * w), bend = -2 / (w * w * w);
    const double across = (4 * d3 * q + d4 * slope) / (20 * w),
                 along = (12 * d * d * q + 8 * d3 * slope + d4 * bend) / 20;
    EXPECT_NEAR(kernel(w).across, across / M_PI, 1e-14) << w;
    EXPECT_NEAR(kernel(w).excess, (along - across) / M_PI, 1e-14) << w;
  }
  for (const double w : {2., 2.5})
  {
    EXPECT_EQ(kernel(w).across, 0);
    EXPECT_EQ(kernel(w).excess, 0);
  }
}

TEST(DilatationInSpace, needs_an_influence_that_is_smooth_and_not_too_singular)
{
  EXPECT_THROW(DilatationInSpace(influence_function<3>({{1, -2}}, 1)), InputError);
  EXPECT_THROW(
      DilatationInSpace(influence_function<3>(RadialProfile::table({{0, 1}, {.5, .8}, {1, 0}}), 1)),
      InputError);
}

// two ways: products of Bessel's integrals, and the kernel of twice the horizon
TEST(LoadInSpace, of_waves_in_a_solid_is_their_frequency_times_them)
{
  const Point<3> k(3, -1, 2), across(1, 1, -1);
  const double length = k.norm();
  for (const RadialProfile &profile : influences)
  {
    const auto dilatation = solid(profile, {3, 1});
    const Kernel<3> bonds = deviatoric_kernel(dilatation->influence, 1);
    for (const Polarisation p : {Polarisation::longitudinal, Polarisation::transverse})
    {
      const Point<3> along = p == Polarisation::longitudinal ? k : across;
      const auto u = [&](const Point<3> &x, unsigned int c) { return along[c] * std::sin(k * x); };
      const LoadInSpace load(bonds, dilatation, u, samples());
      const double squared = exact_wave(bonds, dilatation, p, length).squared;
      for (const Point<3> &x : {Point<3>(.25, .75, .1), Point<3>(.9, .05, .6)})
        for (unsigned int c = 0; c < 3; ++c)
          EXPECT_NEAR(load(x, c), squared * u(x, c), 1e-12 * squared) << profile(.5);
    }
  }
}

TEST(LoadInSpace, of_cubics_in_a_solid_is_that_of_Navier)
{
  // u = (x z + x³, y² z, x² y): Δu = (6 x, 2 z, 2 y), div u = z + 3 x² + 2 y z
  const auto u = [](const Point<3> &x, unsigned int c)
  {
    return c == 0   ? x[0] * x[2] + std::pow(x[0], 3)
           : c == 1 ? x[1] * x[1] * x[2]
                    : x[0] * x[0] * x[1];
  };
  const Point<3> x(.3, .8, -.2);
  const std::array<double, 3> laplacian = {6 * x[0], 2 * x[2], 2 * x[1]},
                              gradient = {6 * x[0], 2 * x[2], 1 + 2 * x[1]};
  for (const RadialProfile &profile : influences)
    for (const Lame &lame : {Lame{3, 1}, Lame{-.3, 1}, Lame{98, 1}})
    {
      const auto dilatation = solid(profile, lame);
      const LoadInSpace load(deviatoric_kernel(dilatation->influence, lame.mu), dilatation, u,
                             samples());
      for (unsigned int a = 0; a < 3; ++a)
        EXPECT_NEAR(load(x, a), -(lame.mu * laplacian[a] + (lame.lambda + lame.mu) * gradient[a]),
                    1e-12 * (lame.lambda + 2))
            << profile(.5);
    }
}
