#pragma once

#include "analysis/transient.h"
#include "method/method.h"
#include "scene/scene.h"
#include "study/results.h"

#include <functional>

// Scenes that move (Time/final time > 0): what is run, how far it is off, and at which rates.
namespace plumbline::study
{
  using method::Method;
  using method::Methods;

  /// What a Galerkin motion may be wrong by at the final time, of u, L2 over its nodes.
  struct MotionEstimate
  {
    double space = 0;      ///< from h/2, 2 h and degree p + 1
    double quadrature = 0; ///< change to finer quadrature of forces; 0: they are exact
    double time = 0;       ///< from the same equation, exact in time
    double sum() const { return space + quadrature + time; }
  };

  /// One method, scheme and step on one case at one level.
  struct MotionRun
  {
    std::string method; ///< as of Run
    MethodFamily family = MethodFamily::meshfree;
    std::string problem, series;
    std::string scheme;
    std::string steps; ///< as the scene says it, "dt = 0.01" or "0.5 of critical"
    unsigned int level = 0;
    double h = 0, horizon = 0; ///< [length]
    double value = 0;          ///< of DynamicResults::variable
    double step = 0;           ///< Δt [time]
    double critical_step = 0;  ///< of the scheme; infinite: none; 0: unstable at any [time]
    bool is_symmetric = true;  ///< the operator; else critical_step is that of its symmetric part
    analysis::Counts counts;
    base::Cost cost; ///< setup: what does not depend on scheme and step; solve: the steps alone
    double size = 0; ///< of u at the end: largest less least value of a component
    double area = 1; ///< of Ω, as of Run; of a line its length
    /// At the final time, by "norm | target" of u, "velocity norm | target" of its rate; and
    /// "nodal L2 | time" against the same lattice's motion exact in time, at the finest level.
    std::map<std::string, double> errors;
    std::vector<analysis::Energies> energies; ///< over time, the start first
    std::vector<double> history; ///< the decisive error at the same times; empty: not known
    double imbalance = 0;        ///< of energies, see analysis::EnergyLog
    std::optional<MotionEstimate> estimate; ///< of Galerkin methods, where the scene wants it
    std::map<std::string, double> facts;    ///< what a method says of itself
    LimitProof limit;                       ///< of rules, see method::Diagnostics
    std::string failure;                    ///< empty, or what became of it
  };

  /// An error over h, horizon, a variable or Δt, with the scheme.
  struct MotionTrend : Trend
  {
    std::string scheme, steps; ///< steps empty: they are the parameter
    std::string proven;        ///< the rate over levels that theory promises; empty: unknown
  };

  /// The torus without a mesh at one horizon.
  struct TorusEstimate
  {
    std::string problem;
    double horizon = 0;
    unsigned int n_points = 0; ///< a side
    double estimate = 0;       ///< change from 2/3 of the points, of u, L2
    double seconds = 0;
    double value = 0; ///< of DynamicResults::variable
  };

  struct DynamicResults
  {
    std::string scene_name, purpose, regime, scene_text;
    std::string variable; ///< that varies in its regime, else empty
    std::map<std::string, std::string> provenance;
    std::string decisive_error; ///< "norm | target"; empty: there is nothing to hold it against
    double final_time = 0, density = 1, damping = 0;
    bool shows_blow_up = false;
    std::vector<std::pair<std::string, std::string>> facts; ///< of the model, in words
    std::vector<MotionRun> runs;
    std::vector<MotionTrend> trends; ///< the decisive error and the velocity's over levels
    std::vector<MotionTrend> orders; ///< the error in time over steps, at the finest level
    std::vector<TorusEstimate> references;
    std::vector<Omission> omissions;
    std::vector<Expectation> expectations;
    std::vector<std::string> warnings;
    bool is_complete = false;
    unsigned int n_levels = 0; ///< that were asked for, the first so many; 0: all
  };

  /// What results of a scene begin with: all but what is run.
  DynamicResults begin_results(const scene::Scene &scene, unsigned int n_levels);

  /// A state to show.
  struct Frame
  {
    double t = 0;
    const method::EquationOfMotion &equation;
    const analysis::State &state;
  };

  struct MotionControl
  {
    unsigned int n_levels = 0; ///< take the first so many levels only; 0: all
    std::function<void(const std::string &what, double fraction)> on_progress;
    std::function<void(const DynamicResults &)> on_result; ///< runs has grown by one
    std::function<bool()> should_stop;
    std::function<void(const MotionRun &, const Frame &)> on_frame; ///< where Time/frames asks
    /// At the final time of each motion that comes there; area: of Ω.
    std::function<void(const MotionRun &, const Frame &, double area)> on_end;
    /// Among which there is one that moves a torus without a mesh, where that is the reference;
    /// empty: no reference is made.
    Methods available = {};
  };

  /// What can be refused before anything moves: schemes that are not known or that a method cannot
  /// do, steps beyond the critical one at the finest levels.
  /// @throws InputError  naming the key, and the critical step
  void check_motions(const scene::Scene &scene, const Methods &methods, unsigned int n_levels);

  /// Run all methods, schemes and steps over all cases, series and levels.
  /// @param earlier  motions of the same scene that are taken over, bit by bit as they would be
  /// @throws InputError  as analysis::integrate and TimeSeries::resolve
  DynamicResults run_motions(const scene::Scene &scene, const Methods &methods,
                             const MotionControl &control, const DynamicResults &earlier = {});

  /// Trends, orders and expectations of the runs.
  void conclude(const scene::Scene &scene, DynamicResults &results);
} // namespace plumbline::study
