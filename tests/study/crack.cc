// What a run of a crack gathers, where it may be stopped, and what is said of it.

#include "study/crack.h"

#include "analysis/checkpoint.h"
#include "base/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <unistd.h>

using namespace plumbline;
using namespace plumbline::study;
namespace fs = std::filesystem;

namespace
{
  /// Four numbers that oscillate nonlinearly stand for a strip of two nodes.
  CrackModel model(double damping = .3)
  {
    CrackModel result;
    result.motion = {4,
                     [](const Vector &u, double, Vector &a)
                     {
                       for (std::size_t i = 0; i < 4; ++i)
                         a[i] = -std::sin((1. + static_cast<double>(i)) * u[i]);
                     },
                     {},
                     damping};
    result.start = {.1, .2, .3, .4};
    result.mass = 1;
    result.energy = [](const Vector &u)
    {
      double sum = 0;
      for (std::size_t i = 0; i < 4; ++i)
        sum += (1 - std::cos((1. + static_cast<double>(i)) * u[i])) / (1. + static_cast<double>(i));
      return sum;
    };
    result.view = [](const Vector &u) { return CrackView{u[0], u[1], 1, {u[2], u[3]}}; };
    return result;
  }

  CrackPlan plan(const std::string &name)
  {
    CrackPlan result;
    result.final_time = 3.7;
    result.step = .013;
    result.scheme = "velocity Verlet";
    result.n_samples = 23;
    result.n_frames = 4;
    result.interval = 3;
    result.subject = "four numbers";
    result.checkpoints.folder =
        fs::path(testing::TempDir()) / ("plumbline_" + std::to_string(getpid()) + "_" + name);
    fs::create_directories(result.checkpoints.folder);
    fs::remove(result.checkpoints.file());
    return result;
  }

  struct Killed : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /// A model that ends the run when the tip is looked at for the n-th time.
  CrackModel killed_at(unsigned int n)
  {
    CrackModel result = model();
    result.view = [view = result.view, n](const Vector &u) mutable
    {
      if (n-- == 0)
        throw Killed("killed");
      return view(u);
    };
    return result;
  }

  std::vector<double> all_numbers(const CrackHistory &history)
  {
    std::vector<double> numbers;
    for (const CrackSample &s : history.samples)
      numbers.insert(numbers.end(),
                     {s.t, s.tip, s.kinetic, s.bonds, s.soft, s.dissipated, s.n_branches});
    for (const CrackMoment &moment : history.moments)
    {
      numbers.push_back(moment.t);
      numbers.insert(numbers.end(), moment.damage.begin(), moment.damage.end());
    }
    numbers.insert(numbers.end(), history.last.u.begin(), history.last.u.end());
    numbers.insert(numbers.end(), history.last.v.begin(), history.last.v.end());
    return numbers;
  }

  using Function = std::function<double(double)>;

  /// Samples at t = 0, 1, ..., end of a tip at x(t), in a strip from 0 to 10 that is 5 high, with
  /// shear waves of speed 1.
  CrackMotion described(
      const Function &x, const Function &n_branches = [](double) { return 1; }, int end = 100,
      const Function &kinetic = [](double) { return 0; })
  {
    std::vector<CrackSample> samples;
    for (int t = 0; t <= end; ++t)
    {
      CrackSample sample;
      sample.t = t;
      sample.tip = x(t);
      sample.kinetic = kinetic(t);
      sample.bonds = 5 - sample.kinetic;
      sample.soft = 2 * sample.tip;
      sample.n_branches = n_branches(t);
      samples.push_back(sample);
    }
    return describe_crack(samples, {1, 10, .1, .4, 5, 1});
  }
} // namespace

TEST(Crack, goes_on_from_a_checkpoint_to_the_same_bits_wherever_it_was_killed)
{
  const std::vector<double> whole = all_numbers(run_crack(model(), plan("whole")));
  for (const unsigned int n : {2u, 4u, 7u, 11u, 23u})
  {
    const CrackPlan stopped = plan("killed");
    EXPECT_THROW(run_crack(killed_at(n), stopped), Killed);
    const CrackHistory resumed = run_crack(model(), stopped);
    EXPECT_EQ(resumed.resumed_at > 0, n > 3) << n; // the first checkpoint is behind sample 3
    EXPECT_EQ(all_numbers(resumed), whole) << n;
    fs::remove_all(stopped.checkpoints.folder);
  }
}

TEST(Crack, stops_when_it_is_asked_to_and_goes_on_to_the_same_bits)
{
  const std::vector<double> whole = all_numbers(run_crack(model(), plan("whole")));
  CrackPlan own = plan("stopped");
  own.checkpoints.should_stop = [n = 0]() mutable { return ++n == 4; };
  EXPECT_THROW(run_crack(model(), own), Interrupted);
  const CrackHistory resumed = run_crack(model(), own);
  EXPECT_EQ(resumed.resumed_at, own.time(4)); // no multiple of the interval
  EXPECT_EQ(all_numbers(resumed), whole);
  fs::remove_all(own.checkpoints.folder);
}

TEST(Crack, takes_its_own_checkpoint_alone)
{
  CrackPlan other = plan("subject");
  EXPECT_THROW(run_crack(killed_at(10), other), Killed);
  ASSERT_TRUE(fs::exists(other.checkpoints.file()));
  other.subject = "four other numbers";
  EXPECT_EQ(run_crack(model(), other).resumed_at, 0);
  analysis::write_checkpoint(other.checkpoints.file().string(),
                             {other.subject, {{1, 2, 3, 4}, {1, 2, 3, 4}, 1}, {3, 4}});
  EXPECT_THROW(run_crack(model(), other), InputError);
  fs::remove_all(other.checkpoints.folder);
}

TEST(Crack, frames_and_moments_are_at_even_distances_and_both_ends)
{
  const CrackPlan own = plan("frames");
  std::vector<double> times;
  const CrackHistory history =
      run_crack(model(), own,
                [&](unsigned int frame, const State &state, const CrackView &)
                {
                  EXPECT_EQ(frame, times.size());
                  times.push_back(state.t);
                });
  ASSERT_EQ(times.size(), 5u);
  EXPECT_EQ(times.front(), 0);
  EXPECT_EQ(times.back(), own.final_time);
  EXPECT_NEAR(times[2], .5 * own.final_time, .5 * own.final_time / own.n_samples * 1.001);
  ASSERT_EQ(history.moments.size(), n_crack_moments);
  EXPECT_EQ(history.moments.back().t, own.final_time);
  EXPECT_EQ(history.samples.size(), own.n_samples + 1);
  fs::remove_all(own.checkpoints.folder);
}

TEST(Crack, what_is_dissipated_is_missing_from_the_rest)
{
  CrackPlan fine = plan("balance"), coarse = plan("balance");
  fine.step /= 4;
  const auto drift = [](const CrackPlan &own)
  {
    const auto samples = run_crack(model(), own).samples;
    fs::remove(own.checkpoints.file());
    EXPECT_GT(samples.back().dissipated, .1 * samples.front().bonds);
    return std::abs(samples.back().total() - samples.front().total());
  };
  EXPECT_NEAR(std::log2(drift(coarse) / drift(fine)) / 2, 2, .1); // the order
}

TEST(Crack, is_described_by_where_its_tip_goes)
{
  using scene::CrackOutcome;
  const CrackMotion run = described([](double t) { return 1 + .05 * t; });
  EXPECT_EQ(run.outcome, CrackOutcome::runs);
  EXPECT_NEAR(run.speed, .05, 1e-12);
  EXPECT_NEAR(run.fastest, .05, 1e-12);
  EXPECT_NEAR(run.advance, 5, 1e-12);
  EXPECT_NEAR(run.soft_per_length, 2, 1e-12);
  EXPECT_EQ(run.energy_drift, 0);
  EXPECT_EQ(described([](double t) { return 1 + .05 * t; }, [](double) { return 2; }).outcome,
            CrackOutcome::branches);
  const CrackMotion arrest = described([](double t) { return 1 + std::min(t, 30.) * .01; });
  EXPECT_EQ(arrest.outcome, CrackOutcome::arrests);
  EXPECT_NEAR(arrest.advance, .3, 1e-12);
  // at the strip's end long before the time is over: what comes then is no speed of its own
  const CrackMotion through = described([](double t) { return std::min(10., 1 + .3 * t); });
  EXPECT_EQ(through.outcome, CrackOutcome::runs);
  EXPECT_NEAR(through.speed, .3, 1e-12);
  EXPECT_NEAR(through.fastest, .3, 1e-12);
}

TEST(Crack, has_its_largest_speed_over_tenths_of_its_motion_however_long_it_is_watched)
{
  // gathers speed from t = 5 to 17, a tenth of the time that is watched
  const auto tip = [](double t) { return 1 + .06 * std::pow(std::clamp(t - 5, 0., 12.), 2); };
  const auto one = [](double) { return 1; };
  const CrackMotion motion = described(tip, one, 120);
  EXPECT_GT(motion.speed, .7);
  EXPECT_GT(motion.fastest, motion.speed);
  EXPECT_DOUBLE_EQ(motion.fastest, described(tip, one, 30).fastest);
  double largest = 0;
  for (const auto &[t, speed] : motion.speeds)
    largest = std::max(largest, speed);
  EXPECT_EQ(largest, motion.fastest);
  EXPECT_NEAR(motion.window, 1.2, .3); // of 12
}

TEST(Crack, branches_only_where_two_tips_go_on_side_by_side)
{
  using scene::CrackOutcome;
  const auto outcome = [](const Function &n_branches, int end = 100)
  { return described([](double t) { return 1 + .05 * t; }, n_branches, end).outcome; };
  EXPECT_EQ(outcome([](double t) { return t == 100 ? 2 : 1; }), CrackOutcome::runs); // the last one
  EXPECT_EQ(outcome([](double t) { return t == 50 ? 3 : 1; }), CrackOutcome::runs);
  // four horizons are 32 samples, in one piece
  EXPECT_EQ(outcome([](double t) { return t >= 50 && t < 75 ? 2 : 1; }), CrackOutcome::runs);
  EXPECT_EQ(outcome([](double t) { return static_cast<int>(t) % 10 > 0 ? 2 : 1; }),
            CrackOutcome::runs);
  const Function branched = [](double t) { return t >= 30 && t < 75 ? 2 : 1; };
  for (const int end : {70, 90, 100}) // whenever one looks
    EXPECT_EQ(outcome(branched, end), CrackOutcome::branches) << end;
  // at the end of the strip alone, from x = 9.6 on
  EXPECT_EQ(described([](double t) { return std::min(10., 1 + .1 * t); },
                      [](double t) { return t > 84 ? 2 : 1; })
                .outcome,
            CrackOutcome::runs);
}

TEST(Crack, is_followed_long_enough_or_the_outcome_is_not_told)
{
  using scene::CrackOutcome;
  const Function one = [](double) { return 1; }, still = [](double) { return 1; };
  EXPECT_EQ(described(still, one, 3).outcome, CrackOutcome::too_short);  // 7 crossings of a horizon
  EXPECT_EQ(described(still, one, 8).outcome, CrackOutcome::too_short);  // 1.6 transits
  EXPECT_EQ(described(still, one, 18).outcome, CrackOutcome::too_short); // 3.6 transits
  EXPECT_EQ(described(still, one, 21).outcome, CrackOutcome::arrests);
  const CrackMotion early = described(still, one, 3);
  EXPECT_NE(early.reason.find("Time/final time = 20"), std::string::npos) << early.reason;
  // it begins to move at t = 60, as its kinetic energy tells before
  const Function later = [](double t) { return 1 + .1 * std::max(0., t - 60); };
  const Function kinetic = [](double t) { return 1e-6 * std::exp(.1 * t); };
  for (const int end : {20, 40, 60})
    EXPECT_EQ(described(later, one, end, kinetic).outcome, CrackOutcome::too_short) << end;
  EXPECT_EQ(described(later, one, 100, kinetic).outcome, CrackOutcome::runs);
  // stopped lately, in the second half of the time
  EXPECT_EQ(described([](double t) { return 1 + .05 * std::min(t, 70.); }).outcome,
            CrackOutcome::too_short);
  EXPECT_EQ(described([](double t) { return 1 + .05 * std::min(t, 40.); }).outcome,
            CrackOutcome::arrests);
  // a tip that has not gone two horizons
  EXPECT_EQ(described([](double t) { return 1 + .007 * t; }).outcome, CrackOutcome::too_short);
}

TEST(Crack, warns_of_large_strains)
{
  EXPECT_TRUE(warnings_of_strain(.09).empty());
  const auto warnings = warnings_of_strain(-.11);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("strain of the grips is -0.11"), std::string::npos);
  EXPECT_NE(warnings[0].find("Material/beta times k² and Material/c over k²"), std::string::npos);
}

TEST(Crack, rayleigh_waves_are_a_little_slower_than_shear_waves)
{
  EXPECT_NEAR(rayleigh_ratio(), .9194, 5e-5);
}
