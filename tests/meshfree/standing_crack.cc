// A standing crack in a strip by rules: the numbers of an independent program.

#include "meshfree/fracture/standing_crack.h"
#include "meshfree/rules/rules.h"
#include "physics/state_based.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace plumbline;

  constexpr double horizon = .125;

  method::RiceStrip make_strip(int m, int length = 3)
  {
    const int n = 8 * m;
    return {n, length * n, length * n / 2, horizon / m};
  }

  method::StripState solve(const method::RiceStrip &strip,
                           meshfree::NeighbourhoodQuadrature<2> (*rule)(const physics::Kernel<2> &))
  {
    const auto influence =
        physics::influence_function<2>(physics::kernel_type("1/r").profile, horizon);
    return solve_strip(strip, rule(physics::deviatoric_kernel(influence, 1)), influence);
  }
} // namespace

TEST(StandingCrack, has_the_energies_of_an_independent_program)
{
  struct Known
  {
    meshfree::NeighbourhoodQuadrature<2> (*rule)(const physics::Kernel<2> &);
    int m;
    double intact, tip; // intact over that of the local limit, 6
  };
  constexpr double unknown = 0;
  for (const Known &one : {Known{meshfree::partial_area, 2, .97425, .46131},
                           {meshfree::partial_area, 3, unknown, .44365},
                           {meshfree::partial_area, 8, .93960, .42021},
                           {meshfree::improved_partial_area, 2, unknown, .49414},
                           {meshfree::improved_partial_area, 3, unknown, .45884}})
  {
    const method::RiceStrip strip = make_strip(one.m);
    const method::StripState state = solve(strip, one.rule);
    if (one.intact != unknown)
    {
      EXPECT_NEAR(state.intact / 6, one.intact, 1e-5) << one.m;
    }
    EXPECT_NEAR(state.tip_energy(strip), one.tip, 2e-5) << one.m;
  }
}

// Of the local strip's, by three bonds to a horizon of 1/8, 1/16 and 1/32 of the height: what is
// missing is a number of horizons, for each grip.
TEST(StandingCrack, is_in_a_strip_that_stiffens_to_the_local_one)
{
  constexpr int m = 3;
  double missing = 0;
  for (const auto &[height, known] : {std::pair(8, .93956), {16, .96884}, {32, .98417}})
  {
    const int n = height * m; // W1 is that of any length
    const double W1 =
        solve({n, 4 * m, 2 * m, horizon / m}, meshfree::optimisation_based).intact * height / 48;
    EXPECT_NEAR(W1, known, 1e-5) << height;
    if (missing > 0)
    {
      EXPECT_NEAR(missing / (1 - W1), 2, .08) << height;
    }
    missing = 1 - W1;
  }
}

TEST(StandingCrack, gets_the_energy_of_the_intact_strip_for_its_advance)
{
  method::RiceStrip strip = make_strip(3, 6);
  const method::StripState state = solve(strip, meshfree::partial_area);
  ++strip.n_crack;
  const double release = (state.energy - solve(strip, meshfree::partial_area).energy) / strip.h;
  EXPECT_NEAR(release / state.intact, 1, 1e-6);
}

TEST(StandingCrack, opens_less_the_nearer_to_its_tip)
{
  const method::RiceStrip strip = make_strip(3);
  const auto opening = solve(strip, meshfree::partial_area).opening;
  ASSERT_EQ(opening.size(), static_cast<std::size_t>(strip.n_crack));
  for (std::size_t i = 2 * opening.size() / 3; i + 1 < opening.size(); ++i)
    EXPECT_LT(opening[i + 1], opening[i]);
  EXPECT_NEAR(opening.front(), 2, 1e-2); // as the grips
}

TEST(StandingCrack, in_the_field_of_its_K_gets_what_it_gets_by_a_Galerkin_method)
{
  constexpr double by_DGQ1 = .9702; // limit over m in a square of eight horizons
  for (const auto rule : {meshfree::partial_area<2>, meshfree::improved_partial_area<2>,
                          meshfree::optimisation_based<2>})
  {
    double before = 1;
    for (const int m : {2, 3, 5})
    {
      method::RiceStrip strip = make_strip(m, 1);
      strip.K_tip = strip.n_crack + .5;
      const method::StripState state = solve(strip, rule);
      ++strip.n_crack;
      const double G = (state.energy - solve(strip, rule).energy) / strip.h / state.intact;
      EXPECT_LT(std::abs(G - by_DGQ1), .6 * before) << m;
      before = std::abs(G - by_DGQ1);
    }
    EXPECT_LT(before, .025);
  }
}
