#pragma once

#include "base/cost.h"
#include "method/dynamic_fracture_solver.h"
#include "scene/scene.h"
#include "study/sampled_motion.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

// How a crack moves through a strip: what is planned, run and found out.
namespace plumbline::study
{
  using method::CrackView;

  /// A strip as one side makes it.
  struct CrackModel
  {
    analysis::Motion motion;
    Vector start;    ///< displacements when the motion begins, at rest
    double mass = 0; ///< of a node
    std::function<double(const Vector &u)> energy; ///< of its bonds
    std::function<CrackView(const Vector &u)> view;
  };

  struct CrackSample
  {
    double t = 0, tip = 0, kinetic = 0, bonds = 0, soft = 0;
    double dissipated = 0; ///< by damping, since t = 0
    double n_branches = 0;

    double total() const { return kinetic + bonds + dissipated; }
  };

  /// A picture of the strip.
  struct CrackMoment
  {
    double t = 0;
    Vector damage;
  };

  /// What a motion has gathered.
  struct CrackHistory
  {
    std::vector<CrackSample> samples; ///< from t = 0
    std::vector<CrackMoment> moments;
    State last;
    std::uint64_t n_steps = 0; ///< that were taken
    double resumed_at = 0;     ///< t of the checkpoint that it went on from, or 0
  };

  /// Called at each frame, in order, also of the start.
  using WriteFrame =
      std::function<void(unsigned int frame, const State &state, const CrackView &view)>;

  /// Move the strip as run_samples() does.
  /// @throws InputError  a step that is refused, a checkpoint that cannot be read or written
  /// @throws NumericalError  as analysis::integrate; Interrupted
  CrackHistory run_crack(const CrackModel &model, const CrackPlan &plan,
                         const WriteFrame &write_frame = {});

  /// How a crack moved.
  struct CrackMotion
  {
    double advance = 0; ///< from the notch's tip to the end
    double speed = 0;   ///< of the line fitted to its tip, if it has gone a horizon; see below
    double fastest = 0; ///< the largest of `speeds`
    /// Mean speeds of the tip over windows of a tenth of the time for which it moves, before it
    /// comes to the strip's end: the window's middle [time] and the speed [length/time].
    std::vector<std::array<double, 2>> speeds;
    double window = 0; ///< their length [time]
    scene::CrackOutcome outcome = scene::CrackOutcome::unknown;
    std::string reason;         ///< of the outcome, one sentence with the numbers
    double energy_drift = 0;    ///< max |kinetic + bonds + dissipated - start| / start
    double soft_per_length = 0; ///< rise of the soft bonds' energy per length of advance
  };

  /// What lengths and times a motion is measured by.
  struct CrackScales
  {
    double notch_tip = 0, right_end = 0; ///< x of the strip [length]
    double h = 0, horizon = 0;           ///< [length]
    double height = 0;                   ///< between the grips [length]
    double wave_speed = 0;               ///< of shear waves [length/time]

    double crossing() const { return horizon / wave_speed; } ///< of a horizon
    double transit() const { return height / wave_speed; }   ///< from grip to grip
  };

  /// The line is fitted by least squares where the tip is between 1/5 and 4/5 of its advance. What
  /// comes when the tip is within a horizon of the strip's end is left out of speeds and branches.
  /// The first that holds is the outcome:
  /// - branches: the tip advances by four horizons or more while there are two cracks side by side.
  ///   Fast cracks have others beside them for two horizons or three, which depends on the step;
  /// - runs: it comes within a horizon of the strip's end;
  /// - too short to tell: the time is less than ten crossings of a horizon, or two transits;
  /// - runs: it advances by two horizons or more, and by h or more in the last fifth of the time;
  /// - arrests: it advances by less than h in the second half of the time, which is at least two
  ///   transits, and the kinetic energy does not grow in it;
  /// - too short to tell.
  /// @pre samples are there
  CrackMotion describe_crack(const std::vector<CrackSample> &samples, const CrackScales &scales);

  /// The bonds have linear kinematics, whose relative error is of the size of the strain: above
  /// this strain of the grips a warning says so.
  constexpr double large_strain = .1;

  /// Speed of Rayleigh waves over that of shear waves: the root c of
  /// x³ - 8x² + (24 - 16k) x - 16 (1 - k) = 0, x = c².
  /// @param k  μ/(λ + 2μ); 1/3 if λ = μ, which gives the ratio .9194
  double rayleigh_ratio(double k = 1. / 3);

  std::vector<std::string> warnings_of_strain(double strain);

  /// Check that there is room for the frames of a scene and its checkpoint.
  /// @throws InputError  with the bytes that are needed and those that are free
  void check_room(const CrackPlan &plan, double n_nodes);

  /// What is not in the model, for reports.
  std::vector<std::string> left_out_of_cracks();
} // namespace plumbline::study
