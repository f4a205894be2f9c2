#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace plumbline::scene
{
  /// A text file of values separated by commas, read row by row: the first line names the columns,
  /// in any order, and blanks around a value do not count. Not for: quoted values.
  /// Every function throws InputError that names file, line, column, value and what is allowed.
  class Csv
  {
  public:
    /// @param required  columns that are to be there; others may be
    /// @throws InputError  file not readable, a required column missing, one name for two columns
    Csv(const std::string &file, const std::vector<std::string> &required);

    bool has(const std::string &column) const;

    /// Go to the next row that is not empty, if there is one. A short row ends in empty values.
    /// @throws InputError  more values than columns
    bool next();

    std::size_t line() const { return line_; } ///< of the row in the file, from 1

    // Of a column in the row; a value must be a number as a whole, and may begin with '+'.
    bool is_empty(const std::string &column) const { return value(column).empty(); }
    double number(const std::string &column) const; ///< finite
    std::int64_t integer(const std::string &column) const;

    /// Throw an InputError about a line of the file.
    [[noreturn]] void fail(std::size_t line, const std::string &what) const;
    [[noreturn]] void fail(const std::string &what) const { fail(line_, what); }

  private:
    std::size_t index(const std::string &column) const; ///< n_columns: none
    std::string value(const std::string &column) const;
    template <class Number>
    Number parse(const std::string &column, const std::string &wanted) const;

    std::string file_;
    std::ifstream in_;
    std::size_t line_ = 1;
    std::vector<std::string> columns_, row_;
  };

  /// Rows of numbers.
  struct NumberGrid
  {
    std::array<int, 2> n{};     ///< numbers in a row, rows
    std::vector<double> values; ///< shape (n[1], n[0]), the first row first
  };

  /// A text file of numbers alone, separated by commas: a line for each row, none for names. Blank
  /// lines do not count; a number may begin with '+'.
  /// @throws InputError  as base::read_text_file, more than 1e8 bytes; a value that is no finite
  /// number, rows of different lengths, by line; no numbers at all
  NumberGrid read_number_grid(const std::string &file);
} // namespace plumbline::scene
