// Bodies in motion whose bonds break for good.

#include "study/breaking.h"

#include "analysis/critical_step.h"
#include "base/error.h"
#include "growth_plate.h"
#include "meshfree/fracture/network_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <unistd.h>

using namespace plumbline;
using namespace plumbline::study;
using growth_plate::h;
namespace fs = std::filesystem;

namespace
{
  constexpr double nu_of_bonds = .25;

  /// A plate of 20 × 12 nodes whose grips, in its upper and lower rows, move apart at a speed.
  DrivenBody pulled_plate(double speed, double nu = nu_of_bonds)
  {
    DrivenBody driven{
        meshfree::moving_body(growth_plate::network(growth_plate::plate(20, 12, 5 * h, nu)),
                              {5 * h, 0}),
        analysis::TimeSeries(Vector()),
        1,
        0,
        {}};
    const auto at = [&](double t)
    {
      Vector g(2 * driven.body.parts.nodes.size());
      for (std::size_t i = 0; i < driven.body.parts.nodes.size(); ++i)
        if (!driven.body.motion->is_free(i))
          g[2 * i + 1] = (driven.body.parts.nodes[i][1] > 0 ? .5 : -.5) * speed * t;
      return g;
    };
    driven.drive = analysis::TimeSeries::resolve(at, 1, 1e-12, "grips");
    driven.velocity.assign(driven.body.motion->size(), 0);
    return driven;
  }

  CrackPlan plan(double end, double step, unsigned int n_samples, const std::string &name)
  {
    CrackPlan result;
    result.final_time = end;
    result.step = step;
    result.scheme = "velocity Verlet";
    result.n_samples = n_samples;
    result.interval = 1;
    result.subject = "plate";
    result.checkpoints.folder =
        fs::path(testing::TempDir()) / ("plumbline_" + std::to_string(getpid()) + "_" + name);
    fs::create_directories(result.checkpoints.folder);
    fs::remove(result.checkpoints.file());
    return result;
  }

  double number(const Vector &x, std::size_t seed)
  {
    return std::sin(static_cast<double>(7 * seed + 1) + static_cast<double>(x.size()));
  }

  Vector some_state(std::size_t n, std::size_t seed)
  {
    Vector u(n);
    for (std::size_t i = 0; i < n; ++i)
      u[i] = 1e-3 * number(u, i + seed);
    return u;
  }

  constexpr double fast = 8, end = .5;

  BreakingHistory history_of(unsigned int n_samples, double step, const std::string &name)
  {
    DrivenBody driven = pulled_plate(fast);
    return run_breaking(driven, plan(end, step, n_samples, name));
  }

  /// Sides along a line from (0, 0), one h each, as broken by event i.
  void add_line(CrackPath &path, double angle, int n, int from = 0)
  {
    for (int i = from; i < n; ++i)
    {
      const dealii::Point<2> x = h * (i + .5) * dealii::Point<2>(std::cos(angle), std::sin(angle));
      const auto event = static_cast<std::size_t>(i);
      path.sides.push_back({{x, x}, event, true, event});
    }
  }

  NotchCrack crack_of(const CrackPath &path)
  {
    GrowthModel model;
    model.h = h;
    std::vector<double> times(100);
    for (std::size_t i = 0; i < times.size(); ++i)
      times[i] = .1 * static_cast<double>(i);
    return notch_cracks(model, path, times, {{{-1, 0}, {0, 0}}}, 3 * h).front();
  }
} // namespace

TEST(BreakingMotion, forces_are_the_gradient_of_the_energy)
{
  for (const double nu : {nu_of_bonds, .3})
  {
    DrivenBody driven = pulled_plate(1, nu);
    method::BreakingMotion &motion = *driven.body.motion;
    const Vector u = some_state(motion.size(), 0), v = some_state(motion.size(), 5),
                 g = driven.drive.at(.01);
    motion.restart({3, 40, 200, 777});
    Vector a(u.size()), forward(u), backward(u);
    motion.acceleration(u, g, a);
    analysis::add(forward, 1, v);
    analysis::add(backward, -1, v);
    const double slope = .5 * (motion.energy(forward, g) - motion.energy(backward, g));
    EXPECT_NEAR(motion.product(a, v), -slope, 1e-12 * std::abs(slope) + 1e-18) << "nu = " << nu;
    // the power of the grips is the change of the energy as they move
    Vector rate(g.size());
    for (std::size_t i = 0; i < g.size(); ++i)
      rate[i] = 100 * g[i];
    Vector after(g), before(g);
    analysis::add(after, .5, rate);
    analysis::add(before, -.5, rate);
    const double work = motion.energy(u, after) - motion.energy(u, before);
    EXPECT_NEAR(motion.power(u, Vector(u.size()), g, rate), work, 1e-11 * std::abs(work));
  }
}

TEST(BreakingMotion, a_bond_breaks_once_at_its_limit_and_dissipates_its_energy)
{
  DrivenBody driven = pulled_plate(1);
  method::BreakingMotion &motion = *driven.body.motion;
  const Vector u(motion.size());
  const auto breaks_at = [&](double t) { return motion.break_bonds(u, driven.drive.at(t)); };
  // rest: only bonds between a grip and its free neighbours are stretched, most the vertical ones
  double low = 0, high = 1;
  while (high - low > 1e-12) // the time at which the first bond breaks
  {
    DrivenBody other = pulled_plate(1);
    const double t = .5 * (low + high);
    (other.body.motion->break_bonds(u, other.drive.at(t)).bonds.empty() ? low : high) = t;
  }
  EXPECT_TRUE(breaks_at(low).bonds.empty());
  const double before = motion.energy(u, driven.drive.at(high));
  const auto breaks = breaks_at(high);
  ASSERT_FALSE(breaks.bonds.empty());
  EXPECT_NEAR(breaks.overshoot / static_cast<double>(breaks.bonds.size()), 0, 1e-9);
  EXPECT_NEAR(breaks.energy, before - motion.energy(u, driven.drive.at(high)), 1e-12 * before);
  EXPECT_GT(breaks.energy, 0);
  EXPECT_TRUE(breaks_at(high).bonds.empty()); // they are broken already
  // none carries a force any more, pulled less or pushed
  DrivenBody cut = pulled_plate(1);
  cut.body.motion->restart(breaks.bonds);
  EXPECT_EQ(motion.energy(u, driven.drive.at(.3 * high)),
            cut.body.motion->energy(u, cut.drive.at(.3 * high)));
}

TEST(BreakingMotion, bonds_break_at_the_stretch_and_with_the_energy_of_the_continuum)
{
  // Silling & Askari 2005, sections 3 and 4, in plane strain: bonds of energy c s² r / 2 have, at
  // the same stretch s of all, the energy density pi c s² δ³ / 6, classically 2 (λ + μ) s²; all
  // across a line, at s0, have G = ∫_0^δ dz ∫_z^δ 2 acos(z/r) c s0² r² / 2 dr = c s0² δ⁴ / 4.
  constexpr double delta = 3 * h, G = 1, E = 1;
  for (const double nu : {nu_of_bonds, .3})
  {
    const double lame = E / (2 * (1 + nu) * (1 - 2 * nu)), // λ + μ
        c = 12 * lame / (M_PI * std::pow(delta, 3)),
                 s0 = std::sqrt(4 * G / (c * std::pow(delta, 4)));
    DrivenBody driven = pulled_plate(1, nu);
    method::BreakingMotion &motion = *driven.body.motion;
    const Vector u(motion.size());
    // grips move by t/2: the bonds of length h between them and free nodes have the stretch t/(2h)
    EXPECT_TRUE(motion.break_bonds(u, driven.drive.at((1 - 1e-9) * 2 * h * s0)).bonds.empty());
    const Vector g = driven.drive.at(2.2 * 2 * h * s0), all = motion.displacements(u, g);
    const auto breaks = motion.break_bonds(u, g);
    ASSERT_GT(breaks.bonds.size(), 2 * 20U); // others than these, too
    double energy = 0;
    for (const std::size_t b : breaks.bonds)
    {
      const auto [from, to] = driven.body.parts.bonds[b];
      const dealii::Tensor<1, 2> xi = driven.body.parts.nodes[to] - driven.body.parts.nodes[from];
      double pull = 0;
      for (unsigned int d = 0; d < 2; ++d)
        pull += xi[d] * (all[2 * to + d] - all[2 * from + d]);
      const double stretch = pull / xi.norm_square();
      EXPECT_GE(stretch, s0);
      energy += .5 * c * stretch * stretch * xi.norm() * std::pow(h, 4); // of two cells
    }
    if (nu == nu_of_bonds)
    {
      EXPECT_NEAR(breaks.energy, energy, 1e-11 * energy);
    }
  }
}

TEST(BreakingMotion, the_balance_is_held_against_energies_that_can_be_lost)
{
  BreakingSample start, end;
  start.kinetic = start.drift = 1000; // it flies as a whole
  end = start;
  end.bond = 2; // of which 1 came from nowhere
  end.work = 1;
  EXPECT_DOUBLE_EQ(energy_imbalance({start, end}), .5);
  end.kinetic = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(std::isfinite(energy_imbalance({start, end})));
  EXPECT_EQ(energy_imbalance({start, start}), 0);
  DrivenBody driven = pulled_plate(fast);
  driven.velocity.assign(driven.body.motion->size(), 3.);
  const BreakingSample first = run_breaking(driven, plan(.01, .005, 1, "drift")).samples.front();
  EXPECT_NEAR(first.drift, first.kinetic, 1e-12 * first.kinetic);
}

TEST(BreakingMotion, energy_gained_is_that_of_breaks_that_raise_it)
{
  BreakingHistory history;
  for (const double energy : {2., -.5, 1., -.25})
  {
    TimedBreaks one;
    one.energy = energy;
    history.breaks.push_back(one);
  }
  EXPECT_DOUBLE_EQ(energy_gained(history), .75);
}

TEST(BreakingMotion, one_step_divides_the_times_of_record)
{
  EXPECT_DOUBLE_EQ(recorded_step(12, 120, .03, false), .025);
  EXPECT_DOUBLE_EQ(recorded_step(12, 120, .5, false), .1);
  EXPECT_DOUBLE_EQ(recorded_step(12, 120, .025, true), .025);
  EXPECT_DOUBLE_EQ(recorded_step(46e-6, 120, 1.9166667e-7, true), 46e-6 / 240); // as it is written
  try
  {
    recorded_step(12, 120, .03, true);
    FAIL();
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("write 0.025 or 0.033333333"), std::string::npos)
        << error.what();
  }
}

TEST(BreakingMotion, energy_is_balanced_to_the_square_of_the_step)
{
  // work = kinetic + bonds + broken
  const double coarse = energy_imbalance(history_of(10, .004, "coarse").samples),
               middle = energy_imbalance(history_of(10, .002, "middle").samples),
               fine = energy_imbalance(history_of(10, .001, "fine").samples);
  EXPECT_GT(std::log2(coarse / fine) / 2, 1.5) << coarse << ' ' << middle << ' ' << fine;
  EXPECT_LT(fine, 1e-3);
}

TEST(BreakingMotion, bonds_break_symmetrically_and_their_history_does_not_depend_on_samples)
{
  const BreakingHistory few = history_of(5, .002, "few"), many = history_of(50, .002, "many");
  ASSERT_GT(few.broken(end).size(), 100U);
  EXPECT_EQ(few.broken(end), many.broken(end));
  ASSERT_EQ(few.breaks.size(), many.breaks.size());
  for (std::size_t i = 0; i < few.breaks.size(); ++i)
    EXPECT_NEAR(few.breaks[i].t, many.breaks[i].t, 1e-12);
  EXPECT_NEAR(few.samples.back().broken, many.samples.back().broken,
              1e-9 * few.samples.back().broken);
  const DrivenBody driven = pulled_plate(fast);
  EXPECT_EQ(n_unpaired(driven.body.parts, few.broken(end), 1, 0), 0U);
}

TEST(BreakingMotion, gives_the_same_bits_after_an_interrupt)
{
  const BreakingHistory whole = history_of(12, .004, "whole");
  CrackPlan stopped = plan(end, .004, 12, "stopped");
  unsigned int n = 0;
  // asked at each of the 11 steps to a sample, and then once: within the eighth sample
  stopped.checkpoints.should_stop = [&] { return ++n == 7 * 12 + 5; };
  DrivenBody first = pulled_plate(fast), second = pulled_plate(fast);
  EXPECT_THROW(run_breaking(first, stopped), Interrupted);
  stopped.checkpoints.should_stop = {};
  const BreakingHistory resumed = run_breaking(second, stopped);
  EXPECT_NEAR(resumed.resumed_at, 7 * end / 12, 1e-12);
  ASSERT_GT(whole.broken(resumed.resumed_at).size(), 0U);
  EXPECT_EQ(whole.last.u, resumed.last.u);
  EXPECT_EQ(whole.last.v, resumed.last.v);
  EXPECT_EQ(whole.broken(end), resumed.broken(end));
  for (std::size_t i = 0; i < whole.samples.size(); ++i)
    EXPECT_EQ(whole.samples[i].excess(), resumed.samples[i].excess()) << i;
}

TEST(BreakingMotion, a_body_that_moves_freely_keeps_its_velocity)
{
  meshfree::BreakingSolid<2> solid = growth_plate::plate(10, 8, 3 * h, .3);
  solid.grips.clear();
  DrivenBody driven{meshfree::moving_body(growth_plate::network(solid), {3 * h, 0}),
                    analysis::TimeSeries(Vector(160)), 2, 0, Vector(160, 3.)};
  const BreakingHistory history = run_breaking(driven, plan(1, .01, 4, "free"));
  EXPECT_TRUE(history.breaks.empty());
  for (std::size_t i = 0; i < 160; ++i)
    EXPECT_NEAR(history.last.u[i], 3, 1e-11);
  EXPECT_NEAR(history.samples.back().kinetic, .5 * 2 * 9 * 160 * h * h, 1e-11);
  EXPECT_NEAR(history.samples.back().bond, 0, 1e-18);
}

TEST(BreakingMotion, schemes_with_steps_of_their_own_are_refused)
{
  DrivenBody driven = pulled_plate(1);
  CrackPlan one = plan(end, .01, 2, "adaptive");
  one.scheme = "Runge-Kutta";
  EXPECT_THROW(run_breaking(driven, one), InputError);
}

TEST(NotchCracks, angle_speed_and_branches_follow_from_the_sides)
{
  CrackPath straight;
  add_line(straight, M_PI / 3, 40);
  NotchCrack crack = crack_of(straight);
  EXPECT_NEAR(crack.angle, 60, 1e-9);
  EXPECT_NEAR(crack.advance, 39.5 * h, 1e-12);
  EXPECT_NEAR(*fitted_speed(crack, 2 * h), h / .1, 1e-9);
  EXPECT_NEAR(*fastest_speed(crack, 2 * h), h / .1, 1e-9);
  for (std::size_t i = 20; i < 40; ++i) // it meets a crack that began ahead of it
    crack.tip[i] += 20 * h;
  crack.advance += 20 * h;
  EXPECT_NEAR(*fitted_speed(crack, 2 * h), h / .1, 1e-9);
  EXPECT_NEAR(*fastest_speed(crack, 2 * h), h / .1, 1e-9);
  crack.t.resize(2); // nothing to fit
  crack.tip.resize(2);
  EXPECT_FALSE(fitted_speed(crack, 2 * h));
  EXPECT_FALSE(fastest_speed(crack, 2 * h));
  EXPECT_EQ(crack.branched, 0);

  CrackPath fork; // two branches, farther apart than a horizon from some 9 h on
  add_line(fork, M_PI / 9, 40);
  add_line(fork, -M_PI / 9, 40);
  crack = crack_of(fork);
  EXPECT_NEAR(crack.branched, (40 - 1.5 / std::sin(M_PI / 9)) * h, 1.5 * h);
  add_line(fork, M_PI / 9, 60, 40); // one goes on: what has branched remains so
  EXPECT_EQ(crack_of(fork).branched, crack.branched);
}

TEST(NotchCracks, faces_behind_the_tip_are_no_advance)
{
  CrackPath path;
  add_line(path, M_PI / 4, 10);
  add_line(path, .9 * M_PI, 40); // along a flank, later
  const NotchCrack crack = crack_of(path);
  EXPECT_NEAR(crack.advance, 9.5 * h, 1e-12);
  EXPECT_NEAR(crack.angle, 45, 1e-9);
  EXPECT_NEAR(crack.last_joined, 3.9, 1e-12); // but cracks grew until then
}

TEST(NotchCracks, notches_have_their_mouths_at_the_boundary)
{
  const GrowthModel body = std::move(pulled_plate(1).body.parts);
  const auto check = [&](double mouth) {
    check_mouths(body, {{{mouth, 0}, {10 * h, 0}}}, {100, 0});
  };
  EXPECT_NO_THROW(check(-h));
  EXPECT_NO_THROW(check(0));
  EXPECT_NO_THROW(check(20 * h));
  try
  {
    check(5 * h);
    FAIL();
  }
  catch (const InputError &error)
  {
    const std::string text = error.what();
    EXPECT_NE(text.find("(100.2, 0)"), std::string::npos) << text;
    EXPECT_NE(text.find("from its mouth to its tip"), std::string::npos) << text;
  }
}

TEST(NotchCracks, a_seam_between_boxes_is_no_boundary)
{
  meshfree::BreakingSolid<2> solid = growth_plate::plate(20, 12, 5 * h, nu_of_bonds);
  const auto body = [&] { return moving_body(growth_plate::network(solid), {5 * h, 0}).parts; };
  const GrowthModel one = body();
  const geometry::Box whole = solid.domain.include.front();
  solid.domain.include = {{whole.lower, {10 * h, whole.upper[1]}},
                          {{10 * h, whole.lower[1]}, whole.upper}};
  const GrowthModel two = body();
  ASSERT_EQ(one.nodes.size(), two.nodes.size());
  for (const double x : {.5, 3.2, 9., 10., 10.5, 16., 17.5, 19.5})
  {
    const dealii::Point<2> at(x * h, .5 * h);
    const bool is = x < 3 || x > 17;
    EXPECT_EQ(is_at_boundary(one, at, 3 * h), is) << x;
    EXPECT_EQ(is_at_boundary(two, at, 3 * h), is) << x;
  }
  EXPECT_TRUE(is_at_boundary(one, {10 * h, 3.5 * h}, 3 * h));
}

TEST(NotchCracks, outcomes_name_what_they_rest_on)
{
  using Outcome = scene::CrackOutcome;
  NotchCrack crack;
  crack.advance = 10;
  crack.t = {1, 9.9};
  crack.tip = {1, 10};
  double last = 9.9;
  const auto outcome = [&](double time, bool is_at_boundary)
  { return judge_breaking(crack, last, time, 1, 1, is_at_boundary).outcome; };
  EXPECT_EQ(outcome(10, false), Outcome::too_short); // it may still branch
  EXPECT_EQ(outcome(10, true), Outcome::runs);
  EXPECT_EQ(outcome(30, false), Outcome::arrests);
  last = 25; // a part of it that is not the farthest, or another crack, still grows
  EXPECT_EQ(outcome(30, false), Outcome::too_short);
  crack.branched = 4;
  EXPECT_EQ(outcome(10, false), Outcome::branches);
  EXPECT_EQ(outcome(1000, true), Outcome::branches); // at any later time
  crack = {};
  last = 0;
  EXPECT_EQ(outcome(5, false), Outcome::too_short); // less than six transits
  EXPECT_EQ(outcome(7, false), Outcome::arrests);
}

TEST(RayleighWaves, have_their_known_speeds)
{
  // nu = 0, 1/4 and 1/2: k = 1/2, 1/3 and 0; the middle one is sqrt(2 - 2/sqrt 3)
  EXPECT_NEAR(rayleigh_ratio(.5), .8740, 1e-4);
  EXPECT_NEAR(rayleigh_ratio(), std::sqrt(2 - 2 / std::sqrt(3.)), 1e-12);
  EXPECT_NEAR(rayleigh_ratio(0), .9553, 1e-4);
}
