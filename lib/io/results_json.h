#pragma once

#include "study/study_results.h"

#include <filesystem>
#include <string>

namespace plumbline::io
{
  /// The number under "schema" of results; it changes when a key changes its meaning or goes away.
  constexpr unsigned int schema = 8;

  /// What a study finds, as results.schema.json describes it. Numbers are the shortest decimals (at
  /// most 17 digits) that read back to the same double; NaN and infinity are null.
  /// @param indent  of nested values; -1: all in one line
  std::string to_json(const study::StudyResults &results, int indent = 1);

  /// @param file  for messages
  /// @throws InputError  no JSON, another schema, a key that is missing or of another type;
  ///                     the message names the file, the key and the remedy
  study::StudyResults from_json(const std::string &text, const std::string &file);

  /// @throws InputError  no such file, or as from_json
  study::StudyResults read_results(const std::filesystem::path &file);
} // namespace plumbline::io
