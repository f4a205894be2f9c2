#pragma once

#include "study/study_results.h"

#include <filesystem>

namespace plumbline::report
{
  /// Write everything into a folder: results.json, tables, charts and report.html.
  /// @throws InputError      dir cannot be written
  /// @throws NumericalError  the charts could not be drawn; all else is written before that
  void write_report(const study::StudyResults &results, const std::filesystem::path &dir);
} // namespace plumbline::report
