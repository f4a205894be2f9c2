#pragma once

#include "study/crack.h"

#include <filesystem>
#include <string>

namespace plumbline::report
{
  /// To follow "the crack" or "it": "runs", "arrests", "was simulated for too short a time to
  /// classify".
  std::string crack_outcome_words(scene::CrackOutcome outcome);

  /// Tables for a terminal.
  std::string crack_text(const study::CrackResults &results);

  /// All that was measured, one object; fields as in study/crack.h, null for what is not known.
  std::string crack_json(const study::CrackResults &results);

  /// Write crack.json, crack.md, crack/samples.csv, pictures and crack.html into a folder.
  /// @throws InputError      dir cannot be written
  /// @throws NumericalError  pictures could not be drawn; all else is written before that
  void write_crack(const study::CrackResults &results, const std::filesystem::path &dir);
} // namespace plumbline::report
