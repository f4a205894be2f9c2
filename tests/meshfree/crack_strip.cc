// Strips with a notch: thresholds, arrest, run and branching of cracks in bonds with two wells.

#include "meshfree/lattice/crack_strip.h"

#include "analysis/critical_step.h"
#include "analysis/integrate.h"
#include "base/error.h"
#include "meshfree/rules/rules.h"

#include <deal.II/base/multithread_info.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::meshfree;
using physics::DoubleWell;

namespace
{
  using Vector = std::vector<double>;
  constexpr double rayleigh = .9194; // speed over that of shear waves at nu = 1/4

  DoubleWell well(double horizon)
  {
    return {2, {{1, 0}}, 1, 1, horizon};
  }

  std::vector<WellBond> bonds(double horizon, double h)
  {
    const auto kernel = well(horizon).linear_kernel();
    return well_bonds(well(horizon), lattice_bonds(full_area(kernel), kernel, h, Backend::fast));
  }

  /// 3 × 1 with a notch of length 1, m = 4
  CrackStrip strip(double horizon)
  {
    const double h = horizon / 4;
    const int n = static_cast<int>(std::lround(1 / h));
    return {bonds(horizon, h), {{3 * n, n}, n, h}};
  }

  analysis::Motion motion_of(const CrackStrip &strip, double damping)
  {
    return {strip.size(), [&](const Vector &u, double, Vector &a) { strip.force(u, a); },
            [&](const Vector &u, const Vector &v, Vector &out) { strip.tangent(u, v, out); },
            damping};
  }

  /// A quarter of a thousand nodes and displacements that soften some bonds of them.
  struct Rough
  {
    CrackStrip strip;
    Vector u;
    explicit Rough(const physics::WellPotential &shape)
        : strip(bonds(.2, .1), {{12, 16}, 5, .1}, shape), u(strip.size())
    {
      for (std::size_t i = 0; i < u.size(); ++i)
        u[i] = .2 * std::sin(1. + static_cast<double>(i) * static_cast<double>(i));
    }
  };
} // namespace

TEST(CrackColumn, thresholds_tend_to_the_toughness_of_the_lattice)
{
  for (const auto &[horizon, expected] :
       {std::pair{.1, .9489}, std::pair{.05, .9736}, std::pair{.025, .9866}})
  {
    const double h = horizon / 4;
    const CrackColumn column(bonds(horizon, h), h, static_cast<int>(std::lround(1 / h)));
    EXPECT_NEAR(column.threshold() / column.toughness(), expected, 6e-5) << horizon;
    EXPECT_NEAR(column.toughness() / well(horizon).toughness(), .9375, 1e-10);
    EXPECT_NEAR(column.density(column.strain(.5)) * column.height(), .5, 1e-12);
  }
}

// what the column stores less two halves is G_c at any potential: as for the exponential above
TEST(CrackColumn, takes_any_potential)
{
  const physics::WellPotential same("Material/potential", "1 - exp(-r)"),
      rational("Material/potential", "r/(1 + r)");
  const CrackColumn built_in(bonds(.1, .025), .025, 40),
      by_expression(bonds(.1, .025), .025, 40, same), other(bonds(.1, .025), .025, 40, rational),
      higher(bonds(.1, .025), .025, 80, rational);
  EXPECT_NEAR(by_expression.threshold(), built_in.threshold(), 1e-10);
  EXPECT_NEAR(by_expression.density(1), built_in.density(1), 1e-13);
  EXPECT_LT(other.density(1), built_in.density(1)); // s/(1 + s) < 1 - e^(-s)
  const double low = 1 - other.threshold() / other.toughness(),
               high = 1 - higher.threshold() / higher.toughness();
  EXPECT_LT(std::abs(low), .1);
  EXPECT_LT(std::abs(high), .7 * std::abs(low));
}

TEST(CrackColumn, halves_stand_still_and_the_whole_is_strained_evenly_far_from_its_grips)
{
  const CrackColumn column(bonds(.05, .0125), .0125, 80);
  const auto halves = column.relax(1.2, true), whole = column.relax(1.2, false);
  const int top = column.n_rows() - 1 - column.n_grip();
  EXPECT_NEAR(halves.u[top / 2 + 10], 1.2 * .5, .05); // moved with the grip
  EXPECT_NEAR((whole.u[50] - whole.u[40]) / (10 * .0125), 1.2, 1e-2);
  EXPECT_LT(halves.energy, whole.energy);
}

TEST(CrackColumn, refuses_what_has_no_crack_between_grips)
{
  EXPECT_THROW(CrackColumn(bonds(.1, .025), .025, 41), InputError);
  EXPECT_THROW(CrackColumn(bonds(.1, .025), .025, 12), InputError);
  EXPECT_THROW((void)CrackColumn(bonds(.1, .025), .025, 40).strain(4 * .4), InputError);
  EXPECT_THROW(CrackStrip(bonds(.1, .025), {{120, 40}, 0, .025}), InputError);
  EXPECT_THROW(CrackStrip(bonds(.1, .025), {{120, 40}, 120, .025}), InputError);
}

TEST(CrackStrip, forces_are_the_slope_of_its_energy_and_tangents_that_of_forces)
{
  for (const physics::WellPotential &shape :
       {physics::WellPotential(), physics::WellPotential("Material/potential", "r/(1 + r)")})
  {
    const Rough rough(shape);
    const CrackStrip &strip = rough.strip;
    constexpr double step = 1e-5;
    Vector f, right, left, slope, direction(strip.size());
    strip.force(rough.u, f);
    const std::size_t constrained = static_cast<std::size_t>(strip.column().n_grip()) * 12;
    for (std::size_t i = 0; i < constrained; ++i)
      EXPECT_EQ(f[i], 0);
    const double size = std::sqrt(analysis::dot(f, f));
    for (std::size_t i = constrained; i < strip.n_nodes() - constrained; i += 7)
      for (const std::size_t unknown : {i, i + strip.n_nodes()})
      {
        Vector u = rough.u;
        u[unknown] += step;
        const double more = strip.energy(u);
        u[unknown] -= 2 * step;
        EXPECT_NEAR(f[unknown], -(more - strip.energy(u)) / (2 * step) / (.1 * .1), 1e-7 * size);
      }
    for (std::size_t i = 0; i < direction.size(); ++i)
      direction[i] =
          i % strip.n_nodes() >= constrained && i % strip.n_nodes() < strip.n_nodes() - constrained
              ? std::cos(static_cast<double>(3 * i))
              : 0;
    Vector u = rough.u;
    analysis::add(u, step, direction);
    strip.force(u, right);
    analysis::add(u, -2 * step, direction);
    strip.force(u, left);
    strip.tangent(rough.u, direction, slope);
    for (std::size_t i = 0; i < f.size(); ++i)
      EXPECT_NEAR(slope[i], (right[i] - left[i]) / (2 * step), 1e-7 * size);
  }
}

TEST(CrackStrip, a_notch_parts_what_is_left_of_its_tip)
{
  // upper part moved up as a whole: what is left of the tip does not feel it, what is right does
  const CrackStrip strip(bonds(.2, .1), {{20, 16}, 10, .1});
  Vector u(strip.size()), f;
  for (std::size_t i = strip.n_nodes() / 2; i < strip.n_nodes(); ++i)
    u[strip.n_nodes() + i] = .01;
  strip.force(u, f);
  const std::size_t row = strip.n_nodes() + strip.n_nodes() / 2; // the first above the plane
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_NEAR(f[row + i], 0, 1e-12) << i;
  for (std::size_t i = 10; i < 20; ++i)
    EXPECT_LT(f[row + i], -.05) << i;
  const auto view = strip.view(Vector(strip.size()));
  EXPECT_DOUBLE_EQ(view.tip, strip.notch_tip());
  EXPECT_NEAR(strip.notch_tip(), 0, 1e-14);
  EXPECT_EQ(view.soft_energy, 0);
  EXPECT_GT(view.damage[strip.n_nodes() / 2], .3); // of the notch
  EXPECT_EQ(view.damage[strip.n_nodes() / 2 + 19], 0);
}

TEST(CrackStrip, runs_above_its_threshold_and_arrests_below)
{
  const CrackStrip one = strip(.1);
  const analysis::Motion motion = motion_of(one, 2);
  const auto &verlet = analysis::scheme("velocity Verlet");
  const double step = .8 * analysis::critical_step(motion, verlet, Vector(motion.n));
  for (const double load : {.97, 1.03})
  {
    const double strain = one.column().strain(load * one.column().threshold());
    analysis::State state{one.at_rest(strain, true), Vector(motion.n), 0};
    const double start = one.view(state.u).tip;
    analysis::integrate(motion, verlet, {step}, 20, state);
    const double early = one.view(state.u).tip;
    analysis::integrate(motion, verlet, {step}, 30, state);
    const double advance = one.view(state.u).tip - early;
    EXPECT_EQ(one.asymmetry(state.u), 0);
    if (load < 1)
    {
      EXPECT_LT(std::abs(advance), 1e-3 * one.h());
      EXPECT_LT(early - start, .1); // a horizon
    }
    else
      EXPECT_GT(advance, 2 * one.h());
  }
}

TEST(CrackStrip, runs_slower_than_rayleigh_waves_and_keeps_its_energy)
{
  const CrackStrip one = strip(.1);
  const double fastest = rayleigh * well(.1).wave_speeds().transverse;
  const analysis::Motion motion = motion_of(one, 0);
  const auto &verlet = analysis::scheme("velocity Verlet");
  const double step = .5 * analysis::critical_step(motion, verlet, Vector(motion.n));
  analysis::State state{one.at_rest(one.column().strain(2 * one.column().toughness()), true),
                        Vector(motion.n), 0};
  const double start = one.energy(state.u);
  double before = 0, tip = 0;
  for (int t = 2; t <= 7; ++t)
  {
    analysis::integrate(motion, verlet, {step}, t, state);
    tip = one.view(state.u).tip;
    if (t > 2)
    {
      EXPECT_LT(tip - before, fastest) << t;
      EXPECT_GT(tip - before, .4 * fastest) << t; // .55 to .6 of it where it runs evenly
    }
    before = tip;
  }
  EXPECT_EQ(one.asymmetry(state.u), 0);
  const double kinetic = .5 * one.h() * one.h() * analysis::dot(state.v, state.v);
  EXPECT_NEAR(one.energy(state.u) + kinetic, start, .005 * start); // Verlet's swing at Δt_c/2
}

TEST(CrackStrip, has_the_same_bits_on_one_thread_and_on_two)
{
  const CrackStrip one = strip(.1);
  const analysis::Motion motion = motion_of(one, 0);
  const auto &verlet = analysis::scheme("velocity Verlet");
  const Vector start = one.at_rest(1.8, false);
  const auto run = [&](unsigned int n_threads)
  {
    dealii::MultithreadInfo::set_thread_limit(n_threads);
    analysis::State state{start, Vector(motion.n), 0};
    analysis::integrate(motion, verlet, {.05}, 2, state);
    return state.u;
  };
  const Vector serial = run(1), parallel = run(2);
  dealii::MultithreadInfo::set_thread_limit();
  EXPECT_EQ(serial, parallel);
  EXPECT_EQ(one.asymmetry(serial), 0);
}
