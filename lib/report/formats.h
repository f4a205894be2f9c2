#pragma once

#include "base/text_file.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace plumbline::report
{
  /// All digits of a number ("%.17g"); empty for a value that is not finite.
  std::string exact(double value);

  /// Four significant digits for people: 0.05, 1.234e-5, but 21120 as it is; an en dash for a value
  /// that is not finite.
  std::string rounded(double value);

  /// Four significant digits, always with an exponent (1.234e-5), so that a column lines up.
  std::string rounded_error(double value);

  /// A number with what may be wrong about it: "2.013 ± 0.031".
  std::string rounded_with_uncertainty(double value, double uncertainty);

  /// A target such as 1e-2: three significant digits at most, always with an exponent.
  std::string short_power(double value);

  /// A time as people say it: "85 µs", "0.51 ms", "3.2 s", "410 s", "22 h"; two significant digits.
  std::string rounded_seconds(double seconds);

  /// Lower-case letters, digits, '.' and '-' for file names: "δ = 0.4" becomes "delta-0.4".
  std::string slug(const std::string &name);

  std::string escape_html(const std::string &text);

  /// Special characters made harmless; Greek letters and signs as mathematics.
  std::string escape_latex(const std::string &text);

  /// A field by RFC 4180: in quotes if it holds a comma, a quote, a line break or outer blanks.
  std::string quote_csv(const std::string &text);

  using base::write_file;

  /// One entry of a table: what the CSV holds (one field or more) and what people read.
  struct Cell
  {
    std::vector<std::string> csv;
    std::string text;
    bool is_number = false;
    // on pages alone
    std::string look = {};               ///< class, e.g. "converges"
    bool is_strong = false;              ///< its text
    std::string marker = {};             ///< HTML before the text, see page::marker
    std::vector<std::string> notes = {}; ///< in small letters after it
    std::string hint = {};               ///< shown where the pointer rests
  };

  Cell text_cell(const std::string &text);
  Cell number_cell(double value);
  Cell error_cell(double value);
  Cell rate_cell(double value); ///< three decimals
  Cell count_cell(std::uint64_t value);
  Cell uncertain_cell(double value, double uncertainty);       ///< two CSV fields
  Cell uncertain_error_cell(double value, double uncertainty); ///< the same, with exponents
  Cell empty_cell();

  /// The head of a column: for people, and one name for each CSV field of its cells.
  struct Column
  {
    Column(const std::string &head) : head(head), csv{head} {}
    Column(const char *head) : Column(std::string(head)) {}
    Column(std::string head, std::vector<std::string> csv)
        : head(std::move(head)), csv(std::move(csv))
    {
    }
    std::string head;
    std::vector<std::string> csv;
    std::string group = {}; ///< head of neighbours together, above their own
  };

  /// Rows all have columns.size() cells.
  struct Table
  {
    std::string caption;
    std::vector<Column> columns;
    std::vector<std::vector<Cell>> rows;
  };

  /// How a part stands on a page: as a section, or folded into the section before it.
  enum class Fold
  {
    none,
    open,
    closed
  };

  /// A table under a heading, with words around it; `id` for links.
  struct Part
  {
    std::string id, head, words; ///< words: below the table
    Table table = {};            ///< without columns: a section of words
    bool is_detail = false;      ///< not for the terminal
    Fold fold = Fold::none;
    std::string lead = {};               ///< words above the table
    bool is_warning = false;             ///< they are
    std::string file = {};               ///< of the table, without ending; empty: ID_table
    bool is_excerpt = false;             ///< of that file, which is written elsewhere
    std::vector<std::string> items = {}; ///< a list below the table
  };

  std::string to_csv(const Table &table);      ///< unrounded, heads in the first line
  std::string to_markdown(const Table &table); ///< rounded, pipe table
  std::string to_latex(const Table &table);    ///< rounded, a tabular of the booktabs package
} // namespace plumbline::report
