#pragma once

#include "study/standing_crack.h"

#include <filesystem>
#include <string>

namespace plumbline::report
{
  /// Tables for a terminal.
  std::string strip_text(const study::StripResults &results);

  /// All that was measured, one object; see schema.md.
  std::string strip_json(const study::StripResults &results);

  /// Write strip.json, strip.md, strip/ with tables and pictures, and strip.html into a folder.
  /// @param faults  what is not as expected
  /// @throws InputError      dir cannot be written
  /// @throws NumericalError  pictures could not be drawn; all else is written before that
  void write_strip(const study::StripResults &results, const std::vector<std::string> &faults,
                   const std::filesystem::path &dir);
} // namespace plumbline::report
