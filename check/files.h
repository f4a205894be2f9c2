#pragma once

#include "check/requirements.h"

#include <filesystem>

namespace plumbline::check
{
  /// report.html with maps, nodes.csv (each node's defects), outliers.csv, cells.vtu (the same on
  /// the cells) and check.json.
  /// @throws InputError  the folder cannot be written
  /// @throws NumericalError  maps cannot be drawn; all else is written
  template <int dim>
  void write_check(const Findings<dim> &found, const Requirements &required, const Input &input,
                   int exit_code, const std::filesystem::path &folder);
} // namespace plumbline::check
