#include "physics/kernel.h"

#include "base/error.h"

#include <deal.II/base/quadrature_lib.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::physics;

namespace
{
  constexpr double horizon = .3;

  RadialProfile profile_of(const KernelType &type)
  {
    return type.make == nullptr
               ? type.profile
               : type.make({{2, -1, 0, .5}, 1, .4, {{0, 2}, {.3, 1.5}, {.5, .2}, {1, .1}}});
  }

  constexpr unsigned int n_parts = 10; ///< of the radius: profiles may break at tenths
  double radius(const dealii::Quadrature<1> &rule, unsigned int q)
  {
    return horizon / n_parts * (q / rule.size() + rule.point(q % rule.size())[0]);
  }

  /// Brute force: Gauss in r, θ (and z), independent of the closed forms.
  double moment_2d(const Kernel<2> &kernel, const std::array<int, 2> &alpha, unsigned int a,
                   unsigned int b)
  {
    const dealii::QGauss<1> gauss(12);
    constexpr int n_angles = 64;
    double sum = 0;
    for (unsigned int q = 0; q < n_parts * gauss.size(); ++q)
      for (int k = 0; k < n_angles; ++k)
      {
        const double r = radius(gauss, q), angle = 2 * M_PI * k / n_angles;
        const Point<2> xi(r * std::cos(angle), r * std::sin(angle));
        sum += gauss.weight(q % gauss.size()) * horizon / n_parts * 2 * M_PI / n_angles * r *
               kernel.radial(r) * kernel.direction_factor(a, b, xi) * std::pow(xi[0], alpha[0]) *
               std::pow(xi[1], alpha[1]);
      }
    return sum;
  }

  double moment_3d(const Kernel<3> &kernel, const std::array<int, 3> &alpha, unsigned int a,
                   unsigned int b)
  {
    const dealii::QGauss<1> gauss(16);
    constexpr int n_angles = 32;
    double sum = 0;
    for (unsigned int q = 0; q < n_parts * gauss.size(); ++q)
      for (unsigned int p = 0; p < gauss.size(); ++p)
        for (int k = 0; k < n_angles; ++k)
        {
          const double r = radius(gauss, q), z = 2 * gauss.point(p)[0] - 1;
          const double angle = 2 * M_PI * k / n_angles, s = std::sqrt(1 - z * z);
          const Point<3> xi(r * s * std::cos(angle), r * s * std::sin(angle), r * z);
          sum += gauss.weight(q % gauss.size()) * horizon / n_parts * 2 * gauss.weight(p) * 2 *
                 M_PI / n_angles * r * r * kernel.radial(r) * kernel.direction_factor(a, b, xi) *
                 std::pow(xi[0], alpha[0]) * std::pow(xi[1], alpha[1]) * std::pow(xi[2], alpha[2]);
        }
    return sum;
  }
} // namespace

TEST(Kernel, moments_in_2d_agree_with_quadrature_for_every_type)
{
  for (const KernelType &type : kernel_types())
  {
    const Kernel<2> kernel(type.structure, profile_of(type), horizon, 1.7);
    for (const auto &alpha :
         {std::array<int, 2>{0, 0}, {2, 0}, {0, 2}, {1, 1}, {2, 2}, {4, 0}, {1, 0}})
      for (unsigned int a = 0; a < kernel.n_components(); ++a)
        for (unsigned int b = 0; b < kernel.n_components(); ++b)
          EXPECT_NEAR(kernel.moment(alpha, a, b), moment_2d(kernel, alpha, a, b), 1e-13)
              << type.name;
  }
}

TEST(Kernel, moments_in_3d_agree_with_quadrature_for_every_type)
{
  for (const KernelType &type : kernel_types())
  {
    const Kernel<3> kernel(type.structure, profile_of(type), horizon, 1.7);
    for (const auto &alpha :
         {std::array<int, 3>{0, 0, 0}, {2, 0, 0}, {0, 2, 2}, {1, 1, 0}, {0, 0, 4}})
      for (unsigned int a = 0; a < kernel.n_components(); ++a)
        for (unsigned int b = 0; b < kernel.n_components(); ++b)
          EXPECT_NEAR(kernel.moment(alpha, a, b), moment_3d(kernel, alpha, a, b), 1e-13)
              << type.name;
  }
}

TEST(Kernel, constants_are_those_of_the_papers)
{
  const double d = horizon;
  const auto scalar = [&](const std::string &name)
  { return Kernel<2>::with_diffusion(kernel_type(name).profile, d, .5); };
  EXPECT_NEAR(scalar("linear-decay").constant() * M_PI * std::pow(d, 4), 20, 1e-12);
  EXPECT_NEAR(scalar("constant").constant() * M_PI * std::pow(d, 4), 4, 1e-12);
  EXPECT_NEAR(scalar("1/r").radial(.1) * M_PI * std::pow(d, 3) * .1, 3, 1e-12);
  const auto profile = kernel_type("bond-tensor").profile;
  const double kappa = 2.5, r = .07;
  EXPECT_NEAR(Kernel<2>::with_bulk_modulus(profile, d, kappa).radial(r) * r,
              72 * kappa / (5 * M_PI * std::pow(d, 3)), 1e-10);
  EXPECT_NEAR(Kernel<3>::with_bulk_modulus(profile, d, kappa).radial(r) * r,
              18 * kappa / (M_PI * std::pow(d, 4)), 1e-10);
}

TEST(Kernel, limits_are_the_operators_asked_for)
{
  const auto profile = kernel_type("conical").profile;
  EXPECT_NEAR(Kernel<2>::with_diffusion(profile, horizon, 1).limit().diffusion, 1, 1e-14);
  EXPECT_NEAR(Kernel<3>::with_diffusion(profile, horizon, .5).limit().diffusion, .5, 1e-14);
  const auto tensor = Kernel<2>::with_bulk_modulus(profile, horizon, 2);
  EXPECT_NEAR(tensor.limit().mu, 1.2, 1e-14);
  EXPECT_NEAR(tensor.limit().lambda, 1.2, 1e-14);
  // ½ ∫ C_11 ξ_1² = λ + 2 μ
  EXPECT_NEAR(.5 * tensor.moment({2, 0}, 0, 0), 3.6, 1e-13);
}

TEST(Kernel, rejects_what_cannot_be_a_kernel)
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
    return "no error";
  };
  EXPECT_EQ(message(
                [] {
                  Kernel<2>(Structure::scalar, {{1, 0}}, -1, 1);
                }),
            "kernel: horizon = -1.000000 is not a positive length; give a horizon > 0");
  EXPECT_EQ(message(
                [] {
                  Kernel<2>(Structure::scalar, {{1, -2}}, 1, 1);
                }),
            "kernel: the profile term r^-2 is not integrable in 2D; use exponents above -2");
  // ∫ (4 - 5 t) t³ dt = 0
  EXPECT_NE(message(
                [] {
                  Kernel<2>::with_diffusion({{4, 0}, {-5, 1}}, 1, 1);
                })
                .find("second moment is 0"),
            std::string::npos);
  EXPECT_NE(message([] { kernel_type("gauss"); }).find("choose one of: linear-decay, constant"),
            std::string::npos);
}
