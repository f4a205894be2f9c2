#pragma once

#include "report/formats.h"

namespace plumbline::report
{
  /// The same without columns whose cells are all empty.
  Table without_empty_columns(const Table &table);

  /// The cell, or an empty one for what is not known.
  Cell known(bool is, const Cell &cell);

  std::vector<std::string> lines_of(const std::string &text);

  /// Words in lines of at most so many characters, all but the first behind blanks.
  std::string wrapped(const std::string &words, std::size_t width, std::size_t indent = 0);

  /// "scene: purpose", or the scene alone.
  std::string heading(const std::string &scene, const std::string &purpose);

  /// So much of a line as fits into so many columns, and " ..." if that is not all.
  std::string fitted(const std::string &line, std::size_t n_columns);

  /// A summary on the terminal has at most so many lines and columns.
  constexpr std::size_t summary_lines = 25, summary_columns = 120;

  /// So many of the lines as there is room for; if that is not all, the last one says how many more
  /// there are, and where.
  std::vector<std::string> first_lines(std::vector<std::string> lines, std::size_t room,
                                       const std::string &where);

  /// In columns that line up; the last one is wrapped at the end of the terminal.
  std::string to_text(const Table &table, std::size_t terminal = 160);
} // namespace plumbline::report
