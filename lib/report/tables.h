#pragma once

#include "report/formats.h"
#include "report/selection.h"

namespace plumbline::report
{
  /// Rows: levels with h, horizon and m = horizon / h. Columns: of each method the decisive
  /// error and the rate from the level before. No value: no solution, or no error of that name.
  Table error_table(const study::StudyResults &results, const Case &one);

  /// One row for each method and case: fitted rate and plateau, verdict and reason.
  Table trend_table(const study::StudyResults &results);

  /// One row for each run.
  Table cost_table(const study::StudyResults &results);

  /// The errors that verdicts do not rest on: finest value, fitted rate, verdict.
  Table other_errors_table(const study::StudyResults &results);

  /// The reference's own uncertainty at each level.
  Table estimate_table(const std::vector<study::ErrorEstimate> &estimates);

  /// A run whose difference from the reference is not at least this many times the reference's own
  /// estimate says little.
  constexpr double trusted_ratio = 10;

  /// The differences too small for the reference: one row each, with the ratio. Differences are the
  /// errors with the target "reference". A level without an estimate (zero) says nothing.
  Table doubtful_differences(const study::StudyResults &results);

  /// Of each method over all its runs: neighbours, weights, residual, backend, notes.
  Table diagnostics_table(const study::StudyResults &results);

  /// The net force of surface terms about each tip of a crack, of each run that has them.
  Table tip_force_table(const study::StudyResults &results);

  /// Bounds on nodal errors by consistency and stability, beside the errors; see
  /// study/truncation.h.
  Table bound_table(const study::StudyResults &results);

  /// Energies of solutions and of what they are compared with, see study/energy.h.
  Table energy_table(const study::StudyResults &results);

  /// What the smallest model saved, where the full one was solved too.
  Table saving_table(const study::StudyResults &results);

  /// The runs without a solution, and why.
  Table failure_table(const study::StudyResults &results);
} // namespace plumbline::report
