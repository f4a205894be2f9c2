#pragma once

#include "analysis/time_series.h"
#include "analysis/transient.h"
#include "geometry/cracks.h"
#include "method/breaking_motion.h"
#include "study/crack.h"
#include "study/growth.h"

#include <functional>
#include <string>
#include <vector>

// Bodies in motion whose bonds break for good: run, and what became of their cracks.
namespace plumbline::study
{
  /// Energies at a time; `broken` is what broken bonds took with them [force].
  struct BreakingSample : analysis::Energies
  {
    double broken = 0;

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
    std::uint64_t n_steps = 0;
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
  /// to a step late. Steps are shortened to end at each sample, so that samples at other times
  /// change the history by rounding alone where their distance is a multiple of the step.
  /// Checkpoints as run_crack.
  /// @throws as run_crack
  BreakingHistory run_breaking(DrivenBody &driven, const CrackPlan &plan,
                               const WriteBreaking &write = {});

  /// The largest change of BreakingSample::excess from its beginning, over the largest energy.
  double energy_imbalance(const std::vector<BreakingSample> &samples);

  /// The part of a crack path that begins at one notch tip.
  struct NotchCrack
  {
    dealii::Point<2> from, to;  ///< the notch's tip, and where the crack is farthest from it
    double way = 0;             ///< between the two [length]
    double angle = 0;           ///< of the way against the notch's direction [degree], in [0, 180]
    double branched = 0;        ///< longest way beside itself, see below [length]
    std::vector<double> t, tip; ///< when the way grew, and to what; it jumps to the far end of a
                                ///< crack that began ahead of it, once the two are joined
  };

  /// Cracks of each notch: a side that hangs together with a notch belongs to the nearest tip. A
  /// crack is branched at a distance from its notch's tip where its sides at this distance, to an
  /// h, lie in two groups or more that are farther apart than a horizon. Broken bonds
  /// stay broken: what has branched remains so, unless all that is between breaks, too.
  std::vector<NotchCrack> notch_cracks(const GrowthModel &model, const CrackPath &path,
                                       const std::vector<double> &times,
                                       const std::vector<geometry::Polyline> &notches,
                                       double horizon);

  struct BreakingOutcome
  {
    scene::CrackOutcome outcome = scene::CrackOutcome::unknown;
    std::string reason;
  };

  /// The first that holds, of the crack that went farthest:
  /// - branches: it is branched over four horizons or more in a row;
  /// - runs: it comes within a horizon of the body's boundary, after two horizons or more;
  /// - arrests: it did not grow in the last third of the time, in which shear waves go at least
  ///   twice through the body;
  /// - too short to tell.
  /// None of the first two is lost when the time is longer, but for branches that come later.
  BreakingOutcome judge_breaking(const NotchCrack &crack, double final_time, double horizon,
                                 double transit, bool is_at_boundary);

  /// Slope of the line fitted to the tip's way where it is between 1/5 and 4/5 of the whole, over
  /// time; 0: fewer than three points.
  double fitted_speed(const NotchCrack &crack);

  /// Largest mean speed over any way of the tip of at least four horizons, in which it does not
  /// jump by more than a horizon at once, to a crack that began ahead of it; 0: there is none.
  double fastest_speed(const NotchCrack &crack, double horizon);

  /// What is not in the model, for reports.
  std::vector<std::string> left_out_of_breaking();
} // namespace plumbline::study
