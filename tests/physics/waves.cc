// Exact waves of the nonlocal operator against closed forms and against its definition.
#include "physics/waves.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace plumbline;
using namespace plumbline::physics;

namespace
{
  /// Double-well bonds of the fourth paper linearised, F = (4 p / (ε³ π)) ∫ J(r/ε) e⊗e Δu / r with
  /// p = 1: C = (4/π) ε⁻⁴ J(t)/t ξ⊗ξ/|ξ|², t = r/ε.
  Kernel<2> double_well(bool is_decaying, double horizon)
  {
    std::vector<PowerTerm> profile{{1, -1}};
    if (is_decaying)
      profile.push_back({-1, 0});
    return {Structure::tensor, profile, horizon, 4 / M_PI / std::pow(horizon, 4)};
  }

  /// ∫ C_aa (1 - cos k ξ_1) dξ by its definition, with many points in polar coordinates.
  double by_definition(const Kernel<2> &kernel, unsigned int a, double k)
  {
    constexpr int n_radii = 2000, n_angles = 400;
    double sum = 0;
    for (int i = 0; i < n_radii; ++i)
      for (int j = 0; j < n_angles; ++j)
      {
        const double r = kernel.horizon() * (i + .5) / n_radii, phi = 2 * M_PI * j / n_angles;
        const Point<2> xi(r * std::cos(phi), r * std::sin(phi));
        sum += kernel.radial(r) * kernel.direction_factor(a, a, xi) * 2 *
               std::pow(std::sin(.5 * k * xi[0]), 2) * r;
      }
    return sum * kernel.horizon() / n_radii * 2 * M_PI / n_angles;
  }

  constexpr auto longitudinal = Polarisation::longitudinal, transverse = Polarisation::transverse;
} // namespace

TEST(ExactWaves, of_the_constant_scalar_kernel_have_a_closed_form)
{
  // c [π δ² - 2 π δ J1(kδ) / k], and its derivative 2 π c δ² J2(kδ) / k
  const Kernel<2> kernel = Kernel<2>::with_diffusion({{1, 0}}, .3, 1);
  const double delta = .3, c = kernel.constant();
  for (const double k : {1., 2 * M_PI, 50., 1000.})
  {
    const Frequency wave = exact_wave(kernel, {}, Polarisation::scalar, k);
    const double exact =
        c * (M_PI * delta * delta - 2 * M_PI * delta * std::cyl_bessel_j(1, k * delta) / k);
    EXPECT_NEAR(wave.squared / exact, 1, k < 2 ? 1e-12 : 1e-13) << k; // the closed form cancels
    EXPECT_NEAR(wave.slope, 2 * M_PI * c * delta * delta * std::cyl_bessel_j(2, k * delta) / k,
                1e-12 * exact / k)
        << k;
  }
}

TEST(ExactWaves, follow_their_definition)
{
  const Kernel<2> scalar = Kernel<2>::with_diffusion({{1, 0}, {-1, 1}}, .4, .5),
                  tensor = Kernel<2>::with_bulk_modulus({{1, -1}}, .4, 1);
  constexpr double tolerance = 1e-6; // the midpoint rule's with 2000 radii
  for (const double k : {2., 2 * M_PI, 40.})
  {
    EXPECT_NEAR(exact_wave(scalar, {}, Polarisation::scalar, k).squared /
                    by_definition(scalar, 0, k),
                1, tolerance);
    EXPECT_NEAR(exact_wave(tensor, {}, longitudinal, k).squared / by_definition(tensor, 0, k), 1,
                tolerance);
    EXPECT_NEAR(exact_wave(tensor, {}, transverse, k).squared / by_definition(tensor, 1, k), 1,
                tolerance);
  }
}

TEST(ExactWaves, of_double_well_bonds_are_as_measured_by_others)
{
  // ε = .2, k = 2π, c = β = 1: an independent prototype's ω² of both J, to its printed digits
  constexpr double k = 2 * M_PI, half_digit = 5.1e-8;
  EXPECT_NEAR(exact_wave(double_well(true, .2), {}, longitudinal, k).squared, 4.7235952,
              half_digit);
  EXPECT_NEAR(exact_wave(double_well(true, .2), {}, transverse, k).squared, 1.6023949, half_digit);
  EXPECT_NEAR(exact_wave(double_well(false, .2), {}, longitudinal, k).squared, 18.4823169,
              half_digit);
  EXPECT_NEAR(exact_wave(double_well(false, .2), {}, transverse, k).squared, 6.3259900, half_digit);
}

TEST(ExactWaves, of_double_well_bonds_have_the_sharp_lipschitz_constant_as_largest)
{
  // in units of p / ε²: 4.529 for J = 1, between waves; for J = 1 - t the largest is the limit of
  // short waves, ∫ C_11 = 4 ∫ J dt = 2
  double constant = 0;
  for (double z = 4; z < 7; z += .02) // its highest wave is between these
    constant = std::max(constant, exact_wave(double_well(false, 1), {}, longitudinal, z).squared);
  EXPECT_NEAR(constant, 4.529, 5.1e-4);
  EXPECT_NEAR(exact_wave(double_well(true, 1), {}, longitudinal, 1000).squared, 2, 1e-3);
}

namespace
{
  /// With λ = 3 and μ = 1.
  template <int dim>
  std::optional<Dilatation<dim>> solid(const RadialProfile &profile)
  {
    return Dilatation<dim>{influence_function<dim>(profile, .3),
                           [](const Point<dim> &) {
                             return Lame{3, 1};
                           },
                           false, true};
  }

  template <int dim>
  void expect_slopes_are_derivatives()
  {
    const auto dilatation = solid<dim>({{1, -1}});
    const Kernel<dim> kernel = deviatoric_kernel(dilatation->influence, 1);
    for (const Polarisation p : {longitudinal, transverse})
      for (const double k : {1., 10., 60.})
      {
        const double step = 1e-4 * k;
        const double difference = (exact_wave(kernel, dilatation, p, k + step).squared -
                                   exact_wave(kernel, dilatation, p, k - step).squared) /
                                  (2 * step);
        EXPECT_NEAR(exact_wave(kernel, dilatation, p, k).slope, difference,
                    1e-6 * (std::abs(difference) + kernel.limit().mu * k))
            << dim << ", " << k;
      }
  }

  template <int dim>
  void expect_long_waves_are_local()
  {
    const auto dilatation = solid<dim>({{1, 0}});
    const Kernel<dim> bonds = deviatoric_kernel(dilatation->influence, 1);
    const double k = 1e-3;
    // ω²/k² = c² (1 - O(k²δ²))
    EXPECT_NEAR(exact_wave(bonds, dilatation, longitudinal, k).squared / (k * k), 5, 1e-6) << dim;
    EXPECT_NEAR(exact_wave(bonds, dilatation, transverse, k).squared / (k * k), 1, 1e-6) << dim;
    EXPECT_NEAR(squared_local_speed(bonds.limit(), Lame{3, 1}, longitudinal), 5, 1e-14) << dim;
    EXPECT_NEAR(squared_local_speed(bonds.limit(), Lame{3, 1}, transverse), 1, 1e-14) << dim;
  }
} // namespace

TEST(ExactWaves, slopes_are_derivatives)
{
  expect_slopes_are_derivatives<2>();
  expect_slopes_are_derivatives<3>();
}

TEST(ExactWaves, tend_to_those_of_the_local_limit)
{
  expect_long_waves_are_local<2>();
  expect_long_waves_are_local<3>();
  const Kernel<2> bonds = double_well(true, .3);
  constexpr double k = 1e-3;
  // c_T² = (p/2) ∫ t² J dt = 1/24 and c_L² = 3 c_T² for J = 1 - t
  EXPECT_NEAR(squared_local_speed(bonds.limit(), {}, transverse), 1. / 24, 1e-15);
  EXPECT_NEAR(squared_local_speed(bonds.limit(), {}, longitudinal), 1. / 8, 1e-15);
  EXPECT_NEAR(exact_wave(bonds, {}, transverse, k).squared / (k * k), 1. / 24, 1e-8);
  EXPECT_NEAR(squared_local_speed(Kernel<2>::with_diffusion({{1, 0}}, .1, .5).limit(), {},
                                  Polarisation::scalar),
              .5, 1e-15);
}

TEST(ExactWaves, of_the_constant_scalar_kernel_in_space_have_a_closed_form)
{
  // c [4π δ³/3 - 4π (sin kδ - kδ cos kδ) / k³]
  const Kernel<3> kernel = Kernel<3>::with_diffusion({{1, 0}}, .3, 1);
  for (const double k : {1., 2 * M_PI, 50., 1000.})
  {
    const double z = .3 * k,
                 exact = 4 * M_PI * kernel.constant() / (k * k * k) *
                         (z * z * z / 3 - std::sin(z) + z * std::cos(z)),
                 slope = 4 * M_PI * kernel.constant() / (k * k * k * k) *
                         (3 * std::sin(z) - 3 * z * std::cos(z) - z * z * std::sin(z));
    const Frequency wave = exact_wave(kernel, {}, Polarisation::scalar, k);
    const double cancelled = k < 2 ? 1e-11 : 1e-13; // digits of the closed form
    EXPECT_NEAR(wave.squared / exact, 1, cancelled) << k;
    EXPECT_NEAR(wave.slope, slope, 10 * cancelled * exact / k) << k;
  }
}

TEST(ExactWaves, in_space_follow_their_definition)
{
  const Kernel<3> scalar = Kernel<3>::with_diffusion({{1, 0}, {-1, 1}}, .4, .5),
                  tensor = Kernel<3>::with_bulk_modulus({{1, -1}}, .4, 1);
  // ∫ C_aa (1 - cos k ξ_1) dξ by midpoints in spherical coordinates about the first axis
  const auto by_definition = [](const Kernel<3> &kernel, unsigned int a, double k)
  {
    constexpr int n_radii = 1000, n_cosines = 400;
    double sum = 0;
    for (int i = 0; i < n_radii; ++i)
      for (int j = 0; j < n_cosines; ++j)
        for (const double turn : {0., M_PI / 2}) // exact for squares of sine and cosine
        {
          const double r = kernel.horizon() * (i + .5) / n_radii,
                       x = r * (2 * (j + .5) / n_cosines - 1), s = std::sqrt(r * r - x * x);
          const Point<3> xi(x, s * std::cos(turn), s * std::sin(turn));
          sum += kernel.radial(r) * kernel.direction_factor(a, a, xi) * 2 *
                 std::pow(std::sin(.5 * k * x), 2) * r * r * M_PI;
        }
    return sum * kernel.horizon() / n_radii * 2 / n_cosines;
  };
  constexpr double tolerance = 1e-4; // the midpoint rule's
  for (const double k : {2., 2 * M_PI, 40.})
  {
    EXPECT_NEAR(exact_wave(scalar, {}, Polarisation::scalar, k).squared /
                    by_definition(scalar, 0, k),
                1, tolerance);
    EXPECT_NEAR(exact_wave(tensor, {}, longitudinal, k).squared / by_definition(tensor, 0, k), 1,
                tolerance);
    EXPECT_NEAR(exact_wave(tensor, {}, transverse, k).squared / by_definition(tensor, 1, k), 1,
                tolerance);
    for (const Polarisation p : {longitudinal, transverse})
    {
      const double step = 1e-5 * k, difference = (exact_wave(tensor, {}, p, k + step).squared -
                                                  exact_wave(tensor, {}, p, k - step).squared) /
                                                 (2 * step);
      EXPECT_NEAR(exact_wave(tensor, {}, p, k).slope / difference, 1, 1e-7);
    }
  }
  // long waves: λ + 2μ and μ, each 3κ/5 for κ = 1
  EXPECT_NEAR(exact_wave(tensor, {}, longitudinal, 1e-4).squared / 1e-8, 9. / 5, 1e-8);
  EXPECT_NEAR(exact_wave(tensor, {}, transverse, 1e-4).squared / 1e-8, 3. / 5, 1e-8);
  EXPECT_NEAR(squared_local_speed(tensor.limit(), {}, longitudinal), 9. / 5, 1e-14);
}
