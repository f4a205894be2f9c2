#pragma once

#include "study/dynamics.h"

#include <filesystem>
#include <string>

namespace plumbline::report
{
  /// For the terminal: rates, orders, the best pairs, what failed, expectations that do not hold.
  std::string dynamics_text(const study::DynamicResults &results);

  /// Everything (schema.md).
  std::string dynamics_json(const study::DynamicResults &results);

  /// dynamics.json, .md and .html, and dynamics/ with charts and their numbers.
  /// @throws NumericalError  gnuplot is missing; the page says so, too
  /// @throws InputError      dir cannot be written
  void write_dynamics(const study::DynamicResults &results, const std::filesystem::path &dir);
} // namespace plumbline::report
