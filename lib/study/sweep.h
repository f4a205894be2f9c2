#pragma once

#include "analysis/statics.h"
#include "scene/scene.h"
#include "study/study_results.h"

#include <functional>

namespace plumbline::study
{
  using analysis::Solution;
  using method::Method;
  using method::Methods;

  /// How a sweep talks to its caller.
  struct SweepControl
  {
    unsigned int n_levels = 0; ///< take the first so many levels only; 0: all
    /// Leave out solves that are expected to take longer [CPU s], by how the two levels before
    /// grew; 0: none.
    double budget = 0;
    std::function<void(const std::string &what, double fraction)> on_progress;
    std::function<void(const StudyResults &)> on_result; ///< after each solve; its lists have grown
    std::function<bool()> should_stop;                   ///< asked before each solve
    std::function<void(const Solution &, const Record &)>
        on_finest; ///< solutions of the finest levels
    std::function<void(const problem::Problem<2> &, const Solution &, const Record &)>
        on_solution; ///< of every level, their runs with errors
    /// How cases are solved; empty: analysis::solve.
    std::function<std::vector<analysis::Outcome>(const Method &,
                                                 const std::vector<const problem::Problem<2> *> &)>
        solve = {};
  };

  /// Run all methods over all cases, series and levels; hold them against exact solution, local
  /// limit and reference; judge.
  /// @param earlier  results of an interrupted run of the same scene: what is in it is not run
  /// again
  StudyResults run_sweep(const scene::Scene &scene, const Methods &methods,
                         const Methods &available, const SweepControl &control,
                         const StudyResults &earlier = {});
} // namespace plumbline::study
