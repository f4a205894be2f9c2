#pragma once

#include "report/formats.h"
#include "study/dynamics.h"

namespace plumbline::report
{
  /// Head of the column of reasons, which are long.
  constexpr const char *const reasons_head = "why";

  /// Over levels: of u and of its rate, one row each for method, case, series and scheme.
  Table motion_rates_table(const study::DynamicResults &results);
  extern const char *const motion_rates_words;

  /// The orders of schemes in time.
  Table orders_table(const study::DynamicResults &results);
  extern const char *const orders_words;

  /// One row for each run that came to the end.
  Table motions_table(const study::DynamicResults &results);
  extern const char *const motions_words;

  /// Own estimates of Galerkin motions, one row a run that has one.
  Table motion_estimates_table(const study::DynamicResults &results);
  extern const char *const motion_estimates_words;

  /// The cheapest pair of h and Δt for each accuracy that was reached.
  Table best_pairs_table(const study::DynamicResults &results);
  extern const char *const best_pairs_words;

  Table motion_facts_table(const study::DynamicResults &results);
  Table torus_table(const study::DynamicResults &results);
  extern const char *const torus_words;
  Table motion_warnings_table(const study::DynamicResults &results);
  Table motion_omissions_table(const study::DynamicResults &results);
  Table motion_expectations_table(const study::DynamicResults &results);
  Table failed_motions_table(const study::DynamicResults &results);

  /// Runs that no other one beats in both error and CPU seconds, by rising error. None where a
  /// variable varies: they are of several problems.
  std::vector<const study::MotionRun *> best_runs(const study::DynamicResults &results);

  /// Of a run, NaN where it has none.
  double decisive_error(const study::DynamicResults &results, const study::MotionRun &run);
} // namespace plumbline::report
