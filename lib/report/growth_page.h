#pragma once

#include "study/growth.h"

#include <filesystem>
#include <string>

namespace plumbline::report
{
  /// Tables for a terminal.
  std::string growth_text(const study::GrowthResults &results);

  /// All that was measured, one object; fields as in schema.md.
  std::string growth_json(const study::GrowthResults &results);

  /// Write grow.json, grow.md, grow/ with tables and pictures, and grow.html into a folder.
  /// @param faults  what does not hold, see study::growth_faults
  /// @throws InputError      dir cannot be written
  /// @throws NumericalError  pictures could not be drawn; all else is written before that
  void write_growth(const study::GrowthResults &results, const std::vector<std::string> &faults,
                    const std::filesystem::path &dir);
} // namespace plumbline::report
