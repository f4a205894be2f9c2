#pragma once

#include "requirements.h"

#include <filesystem>

namespace plumbline::app
{
  /// report.html with maps, nodes.csv (each node's defects), outliers.csv, cells.vtu (the same on
  /// the cells) and check.json.
  /// @throws InputError  the folder cannot be written
  /// @throws NumericalError  maps cannot be drawn; all else is written
  void write_check(const Findings &found, const Requirements &required, const CheckOptions &options,
                   int exit_code, const std::filesystem::path &folder);
} // namespace plumbline::app
