#include "scene/csv.h"

#include "base/error.h"
#include "base/text_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

namespace plumbline::scene
{
  namespace
  {
    std::vector<std::string> split(const std::string &line)
    {
      constexpr auto blank = " \t\r";
      std::vector<std::string> values;
      std::size_t from = 0, comma = 0;
      do
      {
        comma = line.find(',', from);
        std::string value = line.substr(from, comma - from);
        value.erase(0, value.find_first_not_of(blank));
        value.erase(value.find_last_not_of(blank) + 1);
        values.push_back(value);
        from = comma + 1;
      } while (comma != std::string::npos);
      return values;
    }

    /// The finite number that a text is as a whole, if it is one.
    template <class Number>
    std::optional<Number> to_finite(const std::string &text)
    {
      const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
      const char *const end = text.data() + text.size();
      Number number{};
      const auto parsed = std::from_chars(text.data() + (has_plus ? 1 : 0), end, number);
      if (parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(double(number)))
        return {};
      return number;
    }
  } // namespace

  Csv::Csv(const std::string &file, const std::vector<std::string> &required)
      : file_(file), in_(file)
  {
    std::string header;
    std::getline(in_, header);
    if (!in_.is_open() || in_.bad())
      throw InputError("'" + file + "' cannot be read; check its name and folder");
    if (header.compare(0, 3, "\xEF\xBB\xBF") == 0) // a byte order mark, as spreadsheets write it
      header.erase(0, 3);
    columns_ = split(header);
    std::string names;
    for (const std::string &column : required)
      names += (names.empty() ? "" : ",") + column;
    for (const std::string &column : required)
      if (!has(column))
        throw InputError("'" + file + "' has no column " + column + " in its first line '" +
                         base::shown(header, 80) + "'; name the columns there: " + names);
    for (auto column = columns_.begin(); column != columns_.end(); ++column)
      if (!column->empty() && std::find(columns_.begin(), column, *column) != column)
        fail("two columns are named " + base::shown(*column) + "; rename one of them");
  }

  bool Csv::has(const std::string &column) const
  {
    return index(column) < columns_.size();
  }

  bool Csv::next()
  {
    for (std::string text; std::getline(in_, text);)
    {
      ++line_;
      row_ = split(text);
      if (std::all_of(row_.begin(), row_.end(), [](auto &value) { return value.empty(); }))
        continue;
      if (row_.size() > columns_.size())
        fail("'" + base::shown(text) + "' has " + std::to_string(row_.size()) + " values for " +
             std::to_string(columns_.size()) +
             " columns; take some out, or name their columns in the first line");
      row_.resize(columns_.size());
      return true;
    }
    return false;
  }

  double Csv::number(const std::string &column) const
  {
    return parse<double>(column, "a finite number");
  }

  std::int64_t Csv::integer(const std::string &column) const
  {
    return parse<std::int64_t>(column, "an integer");
  }

  void Csv::fail(std::size_t line, const std::string &what) const
  {
    throw InputError("'" + file_ + "', line " + std::to_string(line) + ": " + what);
  }

  std::size_t Csv::index(const std::string &column) const
  {
    return std::find(columns_.begin(), columns_.end(), column) - columns_.begin();
  }

  std::string Csv::value(const std::string &column) const
  {
    return row_.at(index(column));
  }

  template <class Number>
  Number Csv::parse(const std::string &column, const std::string &wanted) const
  {
    const std::string text = value(column);
    const std::optional<Number> number = to_finite<Number>(text);
    if (!number)
      fail(column + " = '" + base::shown(text) + "' is not " + wanted +
           "; mend or take out the line");
    return *number;
  }

  NumberGrid read_number_grid(const std::string &file)
  {
    constexpr std::size_t most_bytes = 100'000'000;
    const std::string what = "'" + file + "'";
    std::istringstream in(base::read_text_file(
        file, what, most_bytes, "the name of a file of numbers separated by ',', a row a line"));
    NumberGrid grid;
    std::size_t line = 0;
    for (std::string text; std::getline(in, text);)
    {
      ++line;
      const auto fail = [&](const std::string &fault)
      { throw InputError(what + ", line " + std::to_string(line) + ": " + fault); };
      const std::vector<std::string> row = split(text);
      if (row.size() == 1 && row[0].empty())
        continue;
      for (const std::string &value : row)
        if (const std::optional<double> number = to_finite<double>(value))
          grid.values.push_back(*number);
        else
          fail("'" + base::shown(value) +
               "' is not a finite number; write numbers such as 0 or 0.5, separated by ','");
      const auto n = static_cast<int>(row.size());
      if (grid.n[1]++ == 0)
        grid.n[0] = n;
      if (n != grid.n[0])
        fail("has " + std::to_string(n) + " numbers, and the rows above have " +
             std::to_string(grid.n[0]) + "; give all rows as many");
    }
    if (grid.values.empty())
      throw InputError(what + " has no numbers; write a row of them a line, separated by ','");
    return grid;
  }
} // namespace plumbline::scene
