#pragma once

#include "report/view.h"
#include "study/sampling.h"

#include <filesystem>
#include <limits>

namespace plumbline::report
{
  /// The number under "schema" of sample.json; as io::schema.
  constexpr unsigned int sampling_schema = 1;

  /// A row for each method, level and set: errors of mean and deviation, or the field's mean and
  /// deviation where no exact one is known.
  Table sampling_field_table(const study::SamplingResults &results);

  /// A row for each quantity of each method at its finest level, over each set.
  Table sampling_quantity_table(const study::SamplingResults &results);

  /// Whether a deviation is round-off.
  bool is_constant(const uq::Statistics &statistics);

  /// A row for each pair of h and set that reaches an error of the mean most cheaply.
  Table sampling_cheapest_table(const study::SamplingResults &results);

  /// A row for each sample that failed.
  Table sampling_failure_table(const study::SamplingResults &results);

  /// A row for each sample of the largest set of a case: its number, as of its file, the values of
  /// its variables and its quantities.
  /// @param most_rows, most_variables  no more than the first so many
  Table
  sampling_samples_table(const study::SamplingResults &results, const study::CaseStatistics &one,
                         std::size_t most_rows = std::numeric_limits<std::size_t>::max(),
                         std::size_t most_variables = std::numeric_limits<std::size_t>::max());

  /// Errors of mean and deviation over h and over the number of samples, and over CPU seconds;
  /// histograms of quantities where 16 samples or more have equal weights (Monte Carlo and
  /// quasi-Monte Carlo); the spectrum of a field of modes.
  std::vector<DataChart> sampling_charts(const study::SamplingResults &results);

  /// Of samples of growth: mean and deviation of the damage; nothing of others.
  std::vector<Picture> sampling_pictures(const study::SamplingResults &results);

  /// What the terminal shows: 25 lines of 120 columns at most, with the answer last.
  /// @param files  where the report is
  std::string sampling_summary(const study::SamplingResults &results, const std::string &files);

  /// All numbers but fields.
  std::string sampling_json(const study::SamplingResults &results);

  /// Write sample.html, .md and .json, and sample/ with tables and pictures.
  /// @throws InputError  dir cannot be written
  /// @throws NumericalError  pictures cannot be drawn; all else is written then
  void write_sampling(const study::SamplingResults &results, const std::vector<std::string> &faults,
                      const std::filesystem::path &dir);
} // namespace plumbline::report
