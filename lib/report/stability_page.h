#pragma once

#include "study/stability.h"

#include <filesystem>
#include <string>

namespace plumbline::report
{
  /// Tables and verdicts for a terminal of 160 columns.
  std::string stability_text(const study::StabilityResults &results);

  /// All that was measured, one object; fields and numbers as in study/stability.h, null for what
  /// is not known.
  std::string stability_json(const study::StabilityResults &results);

  /// Write stability.json, stability.md, pictures and stability.html into a folder.
  /// @throws InputError      dir cannot be written
  /// @throws NumericalError  pictures could not be drawn; all else is written before that
  void write_stability(const study::StabilityResults &results, const std::filesystem::path &dir);
} // namespace plumbline::report
