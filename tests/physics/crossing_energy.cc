#include "physics/crossing_energy.h"

#include "physics/gauss.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace plumbline::physics;

  RadialProfile profile(const std::string &type, double width = 0)
  {
    ProfileKeys keys;
    keys.width = width;
    keys.coefficients = {1, 0, -1};
    keys.singularity = 1;
    keys.table = {{0, 2}, {.25, 1.5}, {.5, .25}, {1, .125}};
    const KernelType &row = kernel_type(type);
    return row.make != nullptr ? row.make(keys) : row.profile;
  }

  std::vector<RadialProfile> profiles()
  {
    return {profile("1/r"),        profile("constant"),     profile("conical"),
            profile("polynomial"), profile("gaussian", .4), profile("exponential", .3),
            profile("table")};
  }

  /// Of a function that may be singular at the ends, by the tanh-sinh rule.
  template <class Function>
  double integral(const Function &f, double from, double to)
  {
    constexpr int n = 60;
    constexpr double step = .06;
    double sum = 0;
    for (int k = -n; k <= n; ++k)
    {
      const double s = .5 * M_PI * std::sinh(k * step), half = .5 * (to - from),
                   weight = .5 * M_PI * std::cosh(k * step) / std::pow(std::cosh(s), 2),
                   x = from + half * (1 + std::tanh(s));
      if (x > from && x < to) // weights there are less than round-off
        sum += step * weight * half * f(x);
    }
    return sum;
  }

  /// Energy of all bonds from depths z below a cut to what is above it, as Silling & Askari 2005
  /// count them: each pair holds C r²/2 at the stretch 1, and its direction is within acos(z/r) of
  /// the normal.
  template <int dim>
  double by_depths(const Kernel<dim> &bonds, const std::vector<double> &breaks)
  {
    const double delta = bonds.horizon();
    const auto of_radius = [&](double r)
    {
      // over depths z < r: 2 acos(z/r) in the plane, the cap's 2π (1 - z/r) in space
      const double angles = integral(
          [&](double z) { return dim == 2 ? 2 * std::acos(z / r) : 2 * M_PI * (1 - z / r); }, 0, r);
      return .5 * bonds.radial(r) * r * r * std::pow(r, dim - 1) * angles;
    };
    double sum = 0, from = 0;
    for (const double t : breaks)
    {
      sum += integral(of_radius, from * delta, t * delta);
      from = t;
    }
    return sum + integral(of_radius, from * delta, delta);
  }

  template <int dim>
  void expect_energy_of_bonds()
  {
    for (const double delta : {.3, 2.})
      for (const RadialProfile &one : profiles())
      {
        const auto K = influence_function<dim>(one, delta);
        const double mu = 1.7, expected = by_depths(deviatoric_kernel(K, mu), one.breaks());
        EXPECT_NEAR(crossing_energy(K, {mu, mu}), expected, 1e-10 * expected);
      }
  }
} // namespace

TEST(CrossingEnergy, is_that_of_all_bonds_between_both_sides_of_a_cut)
{
  expect_energy_of_bonds<2>();
  expect_energy_of_bonds<3>();
}

TEST(CrossingEnergy, gives_the_published_critical_stretches)
{
  const double delta = .4, E = 3, G = 2;
  // Ha & Bobaru 2010, plane stress, nu = 1/3: the micromodulus is constant or conical, and the
  // stiffness of a bond is that over r
  const Lame lame = lame_from_young(E, 1. / 3, PlaneState::stress);
  const auto s0 = [&](const RadialProfile &one)
  { return std::sqrt(G / crossing_energy(influence_function<2>(one, delta), lame)); };
  EXPECT_NEAR(s0({{1, -1}}), std::sqrt(4 * M_PI * G / (9 * E * delta)), 1e-14);
  EXPECT_NEAR(s0({{1, -1}, {-1, 0}}), std::sqrt(5 * M_PI * G / (9 * E * delta)), 1e-14);
  // Silling & Askari 2005, 5G/(9kδ) in space, also where λ ≠ μ
  const Lame solid{2, 1.2};
  EXPECT_NEAR(crossing_energy(influence_function<3>({{1, -1}}, delta), solid),
              9 * (solid.lambda + 2 * solid.mu / 3) * delta / 5, 1e-14);
}
