#pragma once

#include "report/formats.h"
#include "study/stability.h"

namespace plumbline::report
{
  // Columns that are empty throughout are left out of all of these.

  /// One row for each level of each method: what is measured of its operator.
  Table measures_table(const study::StabilityResults &results);

  /// One row for each level whose operator is not symmetric: its own eigenvalues.
  Table eigenvalues_table(const study::StabilityResults &results);

  /// One row for each method and series that has a trend.
  Table powers_table(const study::StabilityResults &results);

  /// One row for each level whose critical time steps are known.
  Table time_steps_table(const study::StabilityResults &results);
  extern const char *const time_steps_words;

  /// One row for each method.
  Table stability_verdicts_table(const study::StabilityResults &results);

  /// The levels without an operator, and why.
  Table missing_operators_table(const study::StabilityResults &results);

  /// What the columns of each table mean.
  extern const char *const measures_words, *const eigenvalues_words, *const powers_words;
} // namespace plumbline::report
