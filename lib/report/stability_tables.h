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

  /// One row for each method.
  Table stability_verdicts_table(const study::StabilityResults &results);

  /// The levels without an operator, and why.
  Table missing_operators_table(const study::StabilityResults &results);

  /// What the columns of each table mean.
  extern const char *const measures_words, *const eigenvalues_words, *const powers_words;

  /// Words in lines of at most so many characters, all but the first behind blanks.
  std::string wrapped(const std::string &words, std::size_t width, std::size_t indent = 0);

  /// In columns that line up, for a terminal of 160 columns.
  std::string to_text(const Table &table);
} // namespace plumbline::report
