#pragma once

#include "study/method.h"

#include <functional>

namespace plumbline::study
{
  /// How a sweep talks to its caller.
  struct SweepControl
  {
    unsigned int n_levels = 0; ///< take the first so many levels only; 0: all
    std::function<void(const std::string &what, double fraction)> on_progress;
    std::function<void(const Results &)> on_result; ///< after each solve, to store what is finished
    std::function<bool()> should_stop;              ///< asked before each solve
    std::function<void(const Solution &, const Run &)>
        on_finest; ///< solutions of the finest levels
  };

  /// The methods that a scene names, in order; "all" gives those that can do it.
  /// @throws InputError  unknown name, or a named method that cannot do the scene, with the reason
  Methods choose_methods(const scene::Scene &scene, const Methods &available);

  /// Check that expressions are finite in Ω and its collar on a grid of samples: for all cases and
  /// series, at the level whose ball reaches farthest.
  /// @throws InputError  naming key and place
  void check_data(const scene::Scene &scene);

  /// Run all methods over all cases, series and levels; hold them against exact solution, local
  /// limit and reference; judge.
  /// @param earlier  results of an interrupted run of the same scene: what is in it is not run
  /// again
  Results run_sweep(const scene::Scene &scene, const Methods &methods, const Methods &available,
                    const SweepControl &control, const Results &earlier = {});
} // namespace plumbline::study
