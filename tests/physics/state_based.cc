#include "physics/state_based.h"

#include "base/error.h"
#include "physics/load.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::physics;

namespace
{
  constexpr double horizon = .4;

  Dilatation<2> homogeneous(const std::string &profile, const Lame &lame)
  {
    return {influence_function<2>(kernel_type(profile).profile, horizon),
            [lame](const Point<2> &) { return lame; }, true, true};
  }
} // namespace

TEST(Lame, constants_are_those_of_the_plane)
{
  const Lame strain = lame_from_young(2.6, .3, PlaneState::strain);
  EXPECT_NEAR(strain.mu, 1, 1e-15);
  EXPECT_NEAR(strain.lambda, 1.5, 1e-14); // 2 μ ν / (1 - 2 ν)
  const Lame stress = lame_from_young(2.6, .3, PlaneState::stress);
  EXPECT_NEAR(stress.mu, 1, 1e-15);
  EXPECT_NEAR(stress.lambda, 6. / 7, 1e-14); // 2 μ ν / (1 - ν)
  EXPECT_NEAR(stress.lambda, 2 * strain.lambda * strain.mu / (strain.lambda + 2 * strain.mu),
              1e-14);
  const Lame bulk = lame_from_bulk(100, 800);
  EXPECT_NEAR(bulk.lambda, 0, 1e-12);
  EXPECT_NEAR(bulk.mu, 100, 1e-12);
  const Lame bond_based = lame_from_bulk(100, 400); // l = d² k
  EXPECT_NEAR(bond_based.lambda, bond_based.mu, 1e-12);
}

TEST(Lame, constants_of_no_solid_are_refused)
{
  for (const double nu : {.5, .7, -1., std::nan("")})
    EXPECT_THROW(lame_from_young(1, nu, PlaneState::strain), InputError) << nu;
  EXPECT_THROW(lame_from_young(0, .3, PlaneState::strain), InputError);
  EXPECT_THROW(lame_from_bulk(-1, 1), InputError);
  EXPECT_THROW(lame_from_bulk(1, 0), InputError);
}

TEST(StateBased, influence_and_bonds_in_space_are_normalised)
{
  for (const std::string profile : {"1/r", "constant", "conical", "linear-decay"})
  {
    const auto influence = influence_function<3>(kernel_type(profile).profile, horizon);
    EXPECT_NEAR(influence.moment({2, 0, 0}), 1, 1e-13) << profile; // a third of ∫K|ξ|²
    const auto limit = deviatoric_kernel(influence, 1.7).limit();
    EXPECT_NEAR(limit.mu, 1.7, 1e-13) << profile;
    EXPECT_NEAR(limit.lambda, 1.7, 1e-13) << profile;
  }
  EXPECT_NEAR(influence_function<3>({{1, -1}}, horizon).radial(.1) * .1,
              3 / (M_PI * std::pow(horizon, 4)), 1e-12);
}

TEST(StateBased, influence_and_bonds_are_normalised)
{
  for (const std::string profile : {"1/r", "constant", "conical", "linear-decay"})
  {
    const auto influence = influence_function<2>(kernel_type(profile).profile, horizon);
    EXPECT_NEAR(influence.moment({2, 0}) + influence.moment({0, 2}), 2, 1e-13) << profile;
    const auto limit = deviatoric_kernel(influence, 1.7).limit();
    EXPECT_NEAR(limit.mu, 1.7, 1e-13) << profile;
    EXPECT_NEAR(limit.lambda, 1.7, 1e-13) << profile;
  }
  const auto influence = influence_function<2>(kernel_type("1/r").profile, horizon);
  EXPECT_NEAR(influence.radial(.1) * .1, 3 / (M_PI * std::pow(horizon, 3)), 1e-12);
}

TEST(StateBased, dilatation_of_linear_and_quadratic_fields_is_their_divergence)
{
  const auto influence = influence_function<2>(kernel_type("1/r").profile, horizon);
  const FieldDilatation theta(influence, Expression("u", "3*x + y + x^2 + x*y, 2*x - y + 4*y^2"));
  for (const Point<2> &x : {Point<2>(.1, .7), Point<2>(-.3, .2)})
    EXPECT_NEAR(theta(x), 3 + 2 * x[0] + x[1] - 1 + 8 * x[1], 1e-12);
}

// For u = a cos(k·x) both parts have closed forms with g = ∫ K ξ_1 sin(κ ξ_1).
TEST(StateBased, load_of_a_wave_has_the_symbol_of_the_dilatation_squared)
{
  const Lame lame{3, 1.2};
  const Dilatation<2> dilatation = homogeneous("1/r", lame);
  const double k1 = 2, k2 = 1.5, kappa = 2.5, a1 = .4, a2 = -.7;
  double g = 0; // 3/(πδ³) ∫ r 2π J_1(κ r) dr by the midpoint rule, to 1e-9
  constexpr int n = 20000;
  for (int i = 0; i < n; ++i)
  {
    const double r = horizon * (i + .5) / n;
    g += 6 / std::pow(horizon, 3) * r * std::cyl_bessel_j(1, kappa * r) * horizon / n;
  }
  const FieldDilatation theta(dilatation.influence,
                              Expression("u", ".4*cos(2*x + 1.5*y), -.7*cos(2*x + 1.5*y)"));
  const DilatationForce force(dilatation, theta);
  const double along = (a1 * k1 + a2 * k2) / kappa;
  const Point<2> x(.2, .9);
  const double phase = k1 * x[0] + k2 * x[1];
  EXPECT_NEAR(theta(x), -along * g * std::sin(phase), 1e-8);
  for (unsigned int c = 0; c < 2; ++c)
    EXPECT_NEAR(force(x, c),
                (lame.lambda - lame.mu) * along * (c == 0 ? k1 : k2) / kappa * g * g *
                    std::cos(phase),
                1e-7);
}

TEST(StateBased, two_point_factors_are_differences_of_harmonic_means)
{
  Dilatation<2> dilatation = homogeneous("1/r", {3, 1});
  dilatation.is_homogeneous = false;
  const Lame a{3, 1}, b{6, 2};
  EXPECT_NEAR(dilatation.factor(a, b), 4 - 4. / 3, 1e-15);
  EXPECT_FALSE(dilatation.is_symmetric());
  dilatation.is_two_point = false;
  EXPECT_NEAR(dilatation.factor(a, b), 2, 1e-15);
  EXPECT_NEAR(dilatation.factor(b, a), 4, 1e-15);
  EXPECT_TRUE(dilatation.is_symmetric());
}

// f θ is taken at the dilatation's own point (variational model): f = λ - μ = x² and θ = x give
// ∫ K ξ_1 [f(x) θ(x) + f(x+ξ) θ(x+ξ)] = ∫ K ξ_1 (x + ξ_1)³, where the other order lacks ξ_1⁴.
TEST(StateBased, load_of_a_heterogeneous_solid_takes_the_factor_of_the_dilatations_own_point)
{
  const Dilatation<2> dilatation{influence_function<2>(kernel_type("1/r").profile, horizon),
                                 [](const Point<2> &x) {
                                   return Lame{2 + x[0] * x[0], 2};
                                 },
                                 false, false};
  const DilatationForce force(dilatation, [](const Point<2> &x) { return x[0]; });
  const double second = dilatation.influence.moment({2, 0}),
               fourth = dilatation.influence.moment({4, 0});
  for (const double x : {-.3, .2, .8})
  {
    EXPECT_NEAR(force(Point<2>(x, .1), 0), -(3 * x * x * second + fourth), 1e-12);
    EXPECT_NEAR(force(Point<2>(x, .1), 1), 0, 1e-12);
  }
}
