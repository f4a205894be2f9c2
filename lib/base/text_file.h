#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace plumbline::base
{
  /// The text of a file that people write: UTF-8 (a byte order mark at its begin is dropped), lines
  /// ended by a line feed, with or without a carriage return.
  /// @param what        opens messages, e.g. "scene 'bar.prm'"
  /// @param most_bytes  more is refused
  /// @param kind        what to give, for the message about a file that cannot be read
  /// @throws InputError  no file, a folder, too long, control characters, no UTF-8; by line
  std::string read_text_file(const std::string &file, const std::string &what,
                             std::size_t most_bytes, const std::string &kind);

  /// @throws InputError  control characters, no UTF-8; by line
  void check_text(const std::string &text, const std::string &what);

  /// @param ending  e.g. ".prm"
  bool has_ending(const std::string &file, const std::string &ending);

  /// Write so that a reader finds the old file or the new one, never a part: a neighbouring file
  /// first, then a rename. Missing folders are made.
  /// @throws InputError  the folder cannot be written
  void write_file(const std::filesystem::path &file, const std::string &text);

  /// A piece of input for a message: its first characters, others than printable ones as '?'.
  std::string shown(const std::string &text, std::size_t longest = 40);
} // namespace plumbline::base
