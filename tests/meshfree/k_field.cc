// A crack in the field of its stress intensity K: what its advance releases, by the numbers of an
// independent program. Field: Irwin 1957, doi:10.1115/1.4011547; Griffith and Irwin: G = K² / E',
// E' = E / (1 - ν²) in plane strain.

#include "meshfree/fracture/breaking_network.h"
#include "meshfree/rules/rules.h"
#include "physics/state_based.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace plumbline;
  using dealii::Point;
  using dealii::Tensor;

  constexpr double nu = .25, mu = 1, m = 3;

  /// u about a tip at 0 at K = 1; the crack is y = 0, x < 0.
  Tensor<1, 2> field(const Point<2> &x)
  {
    constexpr double kappa = 3 - 4 * nu;
    const double half = .5 * std::atan2(x[1], x[0]), sine = std::sin(half), cosine = std::cos(half),
                 size = std::sqrt(x.norm() / (2 * M_PI)) / (2 * mu);
    Tensor<1, 2> u;
    u[0] = size * cosine * (kappa - 1 + 2 * sine * sine);
    u[1] = size * sine * (kappa + 1 - 2 * cosine * cosine);
    return u;
  }

  /// The square [-1, 1]², held at u of a tip at 0 all around, cut from the left to a tip elsewhere.
  meshfree::BreakingNetwork<2> cut_square(double h, double tip)
  {
    const double out = 4 * h, all = 1 + out;
    meshfree::BreakingSolid<2> solid;
    solid.domain.include = {{{-all, -all}, {all, all}}};
    solid.grips = {{{-all, 1}, {all, all}},
                   {{-all, -all}, {all, -1}},
                   {{-all, -1}, {-1, 1}},
                   {{1, -1}, {all, 1}}};
    solid.notch = {{{-all - h, 0}, {tip, 0}}};
    solid.constrained = field;
    solid.material = [](const Point<2> &) { return physics::Lame{mu, mu}; };
    solid.toughness = [](const Point<2> &) { return 1.; };
    const auto influence =
        physics::influence_function<2>(physics::kernel_type("1/r").profile, m * h);
    const auto rule = meshfree::optimisation_based(physics::deviatoric_kernel(influence, 1));
    return {make_bond_network(solid, rule, influence, h, meshfree::Backend::fast),
            problem::Stretch::linear};
  }

  /// G E' / K² of a crack that advances from one tip to another.
  double release(double h, double from, double to)
  {
    const auto energy = [&](double tip) { return cut_square(h, tip).response().energy; };
    constexpr double plane_strain = 2 * mu * (1 + nu) / (1 - nu * nu);
    return plane_strain * (energy(from) - energy(to)) / (to - from);
  }
} // namespace

TEST(KField, of_a_crack_releases_the_energy_of_Griffith_and_Irwin_as_the_lattice_is_refined)
{
  struct Known
  {
    int n;
    double by_a_cell, by_two;
  };
  for (const Known &known : {Known{16, 1.00306, .9841}, {32, 1.00073, .9904}, {64, 1.00008, .9948}})
  {
    const double h = 2. / known.n,
                 left = 1e-7 * h; // a tip in a column of nodes leaves the bonds on it whole
    EXPECT_NEAR(release(h, -.5 * h - left, .5 * h - left), known.by_a_cell, 6e-6) << known.n;
    EXPECT_NEAR(release(h, -h, h), known.by_two, 6e-5) << known.n;
  }
}

TEST(KField, is_what_bonds_around_a_crack_take_up)
{
  constexpr double mu_of_known = .4; // E = 1
  for (const auto &[n, known] : {std::pair{16, 1.42e-2}, {32, 6.8e-3}, {64, 3.3e-3}})
  {
    const double h = 2. / n;
    const meshfree::BreakingNetwork<2> body = cut_square(h, 0);
    double square = 0;
    for (std::size_t i = 0; i < body.displacements().size(); ++i)
      if (body.network().grip[i] < 0)
        square += (body.displacements()[i] - field(body.network().nodes[i])).norm_square() * h * h;
    EXPECT_NEAR(std::sqrt(square) * mu / mu_of_known, known, 5e-5) << n; // as rounded
  }
}
