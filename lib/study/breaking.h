#pragma once

#include "analysis/time_series.h"
#include "analysis/transient.h"
#include "geometry/cracks.h"
#include "method/breaking_motion.h"
#include "study/crack.h"
#include "study/growth.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

// Bodies in motion whose bonds break for good: run, and what became of their cracks.
namespace plumbline::study
{
  /// Energies at a time [force].
  struct BreakingSample : analysis::Energies
  {
    double broken = 0; ///< dissipated in broken bonds since the start
    double drift = 0;  ///< kinetic energy of the mean velocity, a part of `kinetic`

    /// What is missing in the balance: kinetic + bonds + broken + dissipated - work.
    double excess() const { return stored() + broken + dissipated - work; }
  };

  /// Bonds that broke after a step.
  struct TimedBreaks : method::BreakingMotion::Breaks
  {
    double t = 0;
  };

  struct BreakingHistory
  {
    std::vector<BreakingSample> samples; ///< from t = 0
    std::vector<TimedBreaks> breaks;     ///< at the end of every step that had some
    State last;
    double resumed_at = 0;

    std::vector<std::size_t> broken(double until) const; ///< bonds, in the order of time
  };

  /// A body and what drives it.
  struct DrivenBody
  {
    method::MovingBody body;
    analysis::TimeSeries drive; ///< g(t), see method::BreakingMotion
    double density = 1, damping = 0;
    Vector velocity; ///< of free nodes at t = 0; the displacement is 0
  };

  /// Called at each frame, in order, also of the start.
  using WriteBreaking = std::function<void(unsigned int frame, double t, const State &state,
                                           const BreakingHistory &history)>;

  /// Move the body. Bonds break between two steps, so that the motion between two breaks is that of
  /// the scheme, and the energy balance is off by its O(Δt²) for velocity Verlet; a bond breaks up
  /// to a step late. The plan's step must divide the time between two samples, see recorded_step;
  /// samples at other times then change the history by rounding alone. Checkpoints as run_crack.
  /// @throws as run_crack
  BreakingHistory run_breaking(DrivenBody &driven, const CrackPlan &plan,
                               const WriteBreaking &write = {});

  /// The one step of a run: it divides the time between two samples into whole steps.
  /// @param longest   what it must not exceed
  /// @param is_exact  `longest` itself is asked for
  /// @throws InputError  it is, and does not divide that time; names the next steps that do
  double recorded_step(double final_time, unsigned int n_samples, double longest, bool is_exact);

  /// The largest change of BreakingSample::excess from its beginning, over the largest energy of
  /// bonds, broken or not, damping and velocities relative to their mean: a body that flies or is
  /// pushed as a whole does not hide an error. Infinite where a number is not finite.
  double energy_imbalance(const std::vector<BreakingSample> &samples);

  /// By how much the energy of bonds rose in steps in which they broke, >= 0: where λ > μ,
  /// a stretched bond can lower the energy of dilatations that the others compress, so that the
  /// body has more of it once this bond is broken.
  double energy_gained(const BreakingHistory &history);

  /// The part of a crack path that begins at one notch tip.
  struct NotchCrack
  {
    dealii::Point<2> from, to; ///< the notch's tip, and where the crack is farthest from it
    double advance = 0;        ///< distance of the two [length]
    double angle = 0;          ///< of the line between them against the notch [degree]
    double branched = 0;       ///< longest distance over which it has two parts, see below [length]
    std::vector<double> t, tip; ///< when the advance grew, and to what; it jumps to the far end of
                                ///< a crack that began ahead of it, once the two are joined
    double last_joined = 0;     ///< when a side was last joined to it, wherever it is
  };

  /// Cracks of each notch: a side that is connected to a notch belongs to the nearest tip. Sides
  /// that lie behind the tip by more than h, along the notch's flanks, are left out. A crack is
  /// branched at a distance from its notch's tip where its sides at this distance, to an
  /// h, lie in two groups or more that are farther apart than a horizon. Broken bonds
  /// stay broken: what has branched remains so, unless all that is between breaks, too.
  std::vector<NotchCrack> notch_cracks(const GrowthModel &model, const CrackPath &path,
                                       const std::vector<double> &times,
                                       const std::vector<geometry::Polyline> &notches,
                                       double horizon);

  /// A place without a cell of the body is within this distance.
  bool is_at_boundary(const GrowthModel &model, const dealii::Point<2> &x, double distance);

  /// The point of a notch that is to be its mouth must not be within the body.
  /// @throws InputError  it is by more than h; points are given with `origin`
  void check_mouths(const GrowthModel &model, const std::vector<geometry::Polyline> &notches,
                    const dealii::Point<2> &origin);

  struct BreakingOutcome
  {
    scene::CrackOutcome outcome = scene::CrackOutcome::unknown;
    std::string reason;
  };

  /// The first that holds, of the crack that went farthest:
  /// - branches: it is branched over four horizons or more in a row;
  /// - runs: it comes within a horizon of the body's boundary, after two horizons or more;
  /// - arrests: no crack grew anywhere in the last third of the time, in which shear waves go at
  ///   least twice through the body;
  /// - too short to tell.
  /// None of the first two is lost when the time is longer, but for branches that come later.
  /// @param last_joined  when a side was last joined to any crack
  BreakingOutcome judge_breaking(const NotchCrack &crack, double last_joined, double final_time,
                                 double horizon, double transit, bool is_at_boundary);

  /// Slope of the lines fitted to the advance over time where it is between 1/5 and 4/5 of the
  /// whole: one slope for all, and a line for each part between two jumps of more than a horizon;
  /// nothing: fewer than three points in parts of two or more.
  std::optional<double> fitted_speed(const NotchCrack &crack, double horizon);

  /// Largest mean speed over any advance of at least four horizons, in which the tip does not jump
  /// by more than a horizon at once, to a crack that began ahead of it; nothing: there is none.
  std::optional<double> fastest_speed(const NotchCrack &crack, double horizon);

  /// What is not in the model, for reports.
  std::vector<std::string> left_out_of_breaking();
} // namespace plumbline::study
