#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace plumbline::base
{
  /// How many digits the numbers of a column are printed with, at most.
  struct PrintedDigits
  {
    int decimals = 0, significant = 0;
    bool has_zeros = false; ///< at the end of some: all are printed with so many decimals

    void add(const std::string &number);

    /// Largest rounding error of a number of the column, whether it is printed with so many
    /// decimals or with so many significant digits. Short numbers such as 0.05 may be exact: unless
    /// zeros at the end tell how many decimals there are, six significant digits are assumed at
    /// least.
    double rounding(double number) const;
  };

  /// A text file of values in columns, read row by row. The first line that is neither empty nor a
  /// comment names the columns, in any order; a comment line right before the values may name them,
  /// too ("# x y z"). Blanks around a value do not count. Read as well, where nothing else can be
  /// meant, and told by notes(): values separated by ';', tabs or blanks instead of ',', values in
  /// quotes, names of columns in upper case, lines that begin with '#', '%' or '//'.
  /// Every function throws InputError that names file, line, column, value and what is allowed.
  class Csv
  {
  public:
    /// @param required  columns that are to be there; others may be
    /// @param may_lack  of these, what the caller can do without
    /// @throws InputError  file not readable, a required column missing, one name for two columns
    Csv(const std::string &file, const std::vector<std::string> &required,
        const std::vector<std::string> &may_lack = {});

    bool has(const std::string &column) const;

    /// Go to the next row that is not empty, if there is one. A short row ends in empty values.
    /// @throws InputError  more values than columns
    bool next();

    std::size_t line() const { return line_; } ///< of the row in the file, from 1

    // Of a column in the row; a value must be a number as a whole, and may begin with '+'.
    bool is_empty(const std::string &column) const { return value(column).empty(); }
    double number(const std::string &column); ///< finite
    std::int64_t integer(const std::string &column) const;

    /// Of the numbers that were read from a column.
    const PrintedDigits &digits(const std::string &column) { return digits_[column]; }

    /// What is not as it is expected of CSV but read all the same, each a clause.
    std::vector<std::string> notes() const;

    /// Throw an InputError about a line of the file.
    [[noreturn]] void fail(std::size_t line, const std::string &what) const;
    [[noreturn]] void fail(const std::string &what) const { fail(line_, what); }

    /// Throw the InputError about a column that the first line lacks.
    [[noreturn]] void fail_without(const std::string &column) const;

  private:
    void read_header();
    bool names_all(const std::string &header, char separator) const;
    std::vector<std::string> split(const std::string &line, char separator);
    std::size_t index(const std::string &column) const; ///< n_columns: none
    std::string value(const std::string &column) const;
    template <class Number>
    Number parse(const std::string &column, const std::string &wanted) const;

    std::string file_;
    std::vector<std::string> required_, may_lack_;
    std::ifstream in_;
    std::size_t line_ = 0, n_comments_ = 0;
    char separator_ = ','; ///< ' ': blanks
    bool has_quotes_ = false, is_header_comment_ = false;
    std::string header_;
    std::vector<std::string> columns_, row_;
    std::map<std::string, PrintedDigits> digits_;
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
} // namespace plumbline::base
