// A standing crack in a strip by Galerkin methods: bonds between cells against the stencil of the
// lattice, what a crack takes of them, and the numbers of an independent program.

#include "physics/state_based.h"
#include "reference/lattice/stencil.h"
#include "reference/strip/bond_pairs.h"
#include "reference/strip/cracked_strip.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace plumbline;
  using reference::AxisShapes;
  using reference::BondPairs;

  constexpr double horizon = .125;

  physics::Kernel<2> bonds()
  {
    return physics::deviatoric_kernel(
        physics::influence_function<2>(physics::kernel_type("1/r").profile, horizon), 1);
  }

  /// @param length    in heights; the crack is half as long
  /// @param horizons  that the strip is high
  method::RiceStrip make_strip(double m, int length = 3, int horizons = 8)
  {
    const auto n = static_cast<int>(std::lround(horizons * m));
    return {n, length * n, length * n / 2, horizon / m};
  }

  method::StripState solve(int m, bool is_continuous, unsigned int degree)
  {
    return solve_strip(make_strip(m), bonds(), AxisShapes(is_continuous, degree));
  }
} // namespace

TEST(BondPairs, are_entries_of_the_lattice)
{
  for (const unsigned int degree : {0u, 1u, 2u})
    for (const double m : {2., 2.6})
    {
      const AxisShapes shapes(false, degree);
      const double h = horizon / m;
      const BondPairs pairs(bonds(), h, shapes);
      const algebra::Stencil stencil =
          galerkin_stencil(bonds(), h, shapes, geometry::Backend::fast);
      const unsigned int n = pairs.n_functions();
      const double size = std::abs(stencil(0, 0, 0, 0));
      for (int j = 0; j <= pairs.reach(); ++j)
        for (int i = j > 0 ? -pairs.reach() : 1; i <= pairs.reach(); ++i)
        {
          const BondPairs::Form form = pairs.whole(i, j);
          for (unsigned int s = 0; s < n; ++s)
            for (unsigned int t = 0; t < n; ++t)
              for (unsigned int a = 0; a < 2; ++a)
                for (unsigned int b = 0; b < 2; ++b)
                  ASSERT_NEAR(form(2 * s + a, 2 * (n + t) + b), stencil(a * n + s, b * n + t, i, j),
                              2e-14 * size)
                      << degree << ' ' << m << ": " << i << ' ' << j;
        }
    }
}

TEST(BondPairs, that_a_crack_cuts_are_sums_of_those_of_smaller_cells)
{
  const AxisShapes constant(false, 0);
  const BondPairs coarse(bonds(), horizon / 3, constant), fine(bonds(), horizon / 6, constant);
  const double size = coarse.whole(0, 1).cwiseAbs().maxCoeff();
  for (const double tip : {.25, 1., 1.7})
    for (int depth = 1; depth <= 3; ++depth)
      for (int j = depth; j <= 3; ++j)
        for (int i = -3; i <= 3; ++i)
        {
          BondPairs::Form rest = coarse.broken(i, j, depth, tip);
          for (const int a : {0, 1})
            for (const int b : {0, 1})
              for (const int c : {0, 1})
                for (const int d : {0, 1})
                  rest -= fine.broken(2 * i + c - a, 2 * j + d - b, 2 * depth - b, 2 * tip - a);
          EXPECT_LT(rest.cwiseAbs().maxCoeff(), 1e-14 * size) << i << ' ' << j << ' ' << depth;
        }
}

TEST(BondPairs, are_all_cut_behind_a_tip_and_none_ahead)
{
  const BondPairs pairs(bonds(), horizon / 2, AxisShapes(false, 1));
  const BondPairs::Form whole = pairs.whole(1, 2);
  const double size = whole.cwiseAbs().maxCoeff();
  EXPECT_LT((pairs.broken(1, 2, 1, 2) - whole).cwiseAbs().maxCoeff(), 1e-13 * size);
  EXPECT_LT(pairs.broken(1, 2, 1, 0).cwiseAbs().maxCoeff(), 1e-13 * size);
  const BondPairs::Form some = pairs.broken(1, 2, 1, 1);
  EXPECT_GT(some(0, 0), .01 * whole(0, 0));
  EXPECT_LT(some(0, 0), .99 * whole(0, 0));
}

TEST(CrackedStrip, has_the_energies_of_an_independent_program)
{
  struct Known
  {
    bool is_continuous;
    unsigned int degree;
    int m;
    double intact, tip; // intact over that of the local limit, 6
  };
  constexpr double unknown = 0;
  for (const Known &one : {Known{false, 1, 2, .9379446, .41906},
                           {false, 1, 3, .9379233, .41608},
                           {false, 0, 2, 1.07985, .67459},
                           {false, 0, 3, unknown, .54767},
                           {true, 1, 2, unknown, .43910},
                           {true, 1, 3, unknown, .42580}})
  {
    const method::StripState state = solve(one.m, one.is_continuous, one.degree);
    if (one.intact != unknown)
    {
      EXPECT_NEAR(state.intact / 6, one.intact, 5e-6) << one.degree << ' ' << one.m;
    }
    EXPECT_NEAR(state.tip_energy(make_strip(one.m)), one.tip, 1e-5) << one.degree << ' ' << one.m;
  }
}

TEST(CrackedStrip, has_them_at_a_shorter_horizon)
{
  method::RiceStrip strip = make_strip(2, 3, 16); // of height 2: a tip has no unit of length
  const double tip = solve_strip(strip, bonds(), AxisShapes(false, 1)).tip_energy(strip);
  EXPECT_NEAR(tip, .45180, 1e-5);
}

TEST(CrackedStrip, opens_at_its_tip_where_functions_may_jump)
{
  EXPECT_NEAR(solve(2, false, 1).opening.back(), .513, 5e-4);
  EXPECT_NEAR(solve(3, false, 1).opening.back(), .506, 5e-4);
  EXPECT_NEAR(solve(2, true, 1).opening.back(), 0, 1e-12);
}

TEST(CrackedStrip, gets_the_energy_of_the_intact_strip_for_its_advance)
{
  // whatever the space; what is left falls with the distance of the ends
  struct Space
  {
    bool is_continuous;
    unsigned int degree;
    double m;
  };
  for (const Space &space : {Space{false, 0, 2}, {false, 1, 2}, {false, 0, 2.5}, {true, 1, 2}})
  {
    double before = 1;
    for (const int length : {3, 4, 6})
    {
      method::RiceStrip strip = make_strip(space.m, length);
      const AxisShapes shapes(space.is_continuous, space.degree);
      const method::StripState state = solve_strip(strip, bonds(), shapes);
      ++strip.n_crack;
      const double release = (state.energy - solve_strip(strip, bonds(), shapes).energy) / strip.h;
      const double defect = std::abs(release / state.intact - 1);
      EXPECT_LT(defect, .2 * before) << length;
      before = defect;
    }
    EXPECT_LT(before, 1e-7);
  }
}

TEST(CrackedStrip, gets_it_with_nodes_within_sides_on_the_crack)
{
  method::RiceStrip strip = make_strip(2, 3);
  const AxisShapes quadratic(true, 2);
  const method::StripState state = solve_strip(strip, bonds(), quadratic);
  ++strip.n_crack;
  const double release = (state.energy - solve_strip(strip, bonds(), quadratic).energy) / strip.h;
  EXPECT_NEAR(release / state.intact, 1, 1e-4);
}

TEST(CrackedStrip, of_higher_degree_is_nearer_to_the_limit)
{
  // .4140 in the limit of DGQ1 over m
  const double limit = .4140, of_1 = solve(2, false, 1).tip_energy(make_strip(2)),
               of_2 = solve(2, false, 2).tip_energy(make_strip(2));
  EXPECT_LT(std::abs(of_2 - limit), .5 * std::abs(of_1 - limit));
}

TEST(CrackedStrip, in_the_field_of_its_K_gets_what_the_local_solid_does_as_the_horizon_vanishes)
{
  double before = 1;
  for (const int horizons : {4, 8, 16})
  {
    method::RiceStrip strip = make_strip(2, 1, horizons);
    strip.K_tip = strip.n_crack + .5;
    const method::StripState state = solve_strip(strip, bonds(), AxisShapes(false, 1));
    ++strip.n_crack;
    const double after = solve_strip(strip, bonds(), AxisShapes(false, 1)).energy,
                 G = (state.energy - after) / strip.h / state.intact;
    EXPECT_GT(1 - G, 0) << horizons;
    EXPECT_LT(1 - G, .62 * before) << horizons;
    before = 1 - G;
  }
  EXPECT_LT(before, .02);
}
