#pragma once

#include "study/results.h"

#include <filesystem>
#include <string>

namespace plumbline::report
{
  /// The number that stands under "schema"; it changes when a key changes its meaning or goes away.
  constexpr unsigned int schema = 6;

  /// Everything of one run, as schema.md describes it. Numbers are the shortest decimals (at most
  /// 17 digits) that read back to the same double; NaN and infinity are null, and read back as NaN.
  /// @param indent  of nested values; -1: all in one line
  std::string to_json(const study::Results &results, int indent = -1);

  /// @param file  for messages
  /// @throws InputError  no JSON, another schema, a key that is missing or of another type; the
  ///                     message names the file, the key and the remedy
  study::Results from_json(const std::string &text, const std::string &file);

  /// The file is replaced at once, never half written.
  /// @throws InputError  the folder cannot be written
  void write_json(const study::Results &results, const std::filesystem::path &file);

  /// @throws InputError  no such file, or as from_json
  study::Results read_json(const std::filesystem::path &file);
} // namespace plumbline::report
