#pragma once

#include "study/dispersion.h"

#include <filesystem>
#include <string>

namespace plumbline::report
{
  /// Tables and verdicts for a terminal of 160 columns.
  std::string dispersion_text(const study::DispersionResults &results);

  /// All that was measured, one object; fields and numbers as in study/dispersion.h, null for what
  /// is not known.
  std::string dispersion_json(const study::DispersionResults &results);

  /// Write dispersion.json, dispersion.md, charts and dispersion.html into a folder.
  /// @throws InputError      dir cannot be written
  /// @throws NumericalError  charts could not be drawn; all else is written before that
  void write_dispersion(const study::DispersionResults &results, const std::filesystem::path &dir);
} // namespace plumbline::report
