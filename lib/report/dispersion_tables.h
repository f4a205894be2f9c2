#pragma once

#include "report/formats.h"
#include "study/dispersion.h"

namespace plumbline::report
{
  /// One row for each method and series: what its waves tend to, beside what is proven of its
  /// moments or space.
  Table wave_verdicts_table(const study::DispersionResults &results);

  /// One row for each method and series, of its finest level: errors of long waves' speed in each
  /// direction, and how it differs between directions.
  Table long_waves_table(const study::DispersionResults &results);

  /// One row for each level of each method: errors of the longest wave, the largest ω² and the
  /// critical time step.
  Table wave_levels_table(const study::DispersionResults &results);

  /// The levels without waves, and why.
  Table missing_waves_table(const study::DispersionResults &results);

  /// What the columns of each table mean.
  extern const char *const long_waves_words, *const wave_levels_words;

  /// What is proven in a word: "AC", "not AC", or empty.
  std::string in_a_word(const study::LimitProof &proof);

  /// "L, 22.5°"; of scalars "22.5°".
  std::string title(const study::WaveCurve &curve);

  /// Of each series the finest level, method by method; those without waves are left out.
  std::vector<const study::DispersionRow *> finest_rows(const study::DispersionResults &results);
} // namespace plumbline::report
