#include "base/csv.h"

#include "base/error.h"
#include "base/text_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

namespace plumbline::base
{
  namespace
  {
    constexpr auto blank = " \t\r";

    void trim(std::string &text)
    {
      text.erase(0, text.find_first_not_of(blank));
      text.erase(text.find_last_not_of(blank) + 1);
    }

    std::string lower(std::string text)
    {
      std::transform(text.begin(), text.end(), text.begin(),
                     [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      return text;
    }

    /// Takes the quotes around a value off.
    /// @return  whether there were some
    bool unquote(std::string &value)
    {
      const bool is_quoted =
          value.size() > 1 && (value[0] == '"' || value[0] == '\'') && value.back() == value[0];
      if (is_quoted)
      {
        value = value.substr(1, value.size() - 2);
        trim(value);
      }
      return is_quoted;
    }

    /// Without blanks around the values. A separator in double quotes is part of the value.
    /// @param separator  ' ': any number of blanks
    std::vector<std::string> split_line(const std::string &line, char separator)
    {
      std::vector<std::string> values;
      if (separator == ' ')
      {
        std::istringstream in(line);
        for (std::string value; in >> value;)
          values.push_back(value);
        return values;
      }
      bool is_inside = false;
      values.emplace_back();
      for (const char c : line)
      {
        is_inside = c == '"' ? !is_inside : is_inside;
        if (c == separator && !is_inside)
          values.emplace_back();
        else
          values.back() += c;
      }
      for (std::string &value : values)
        trim(value);
      return values;
    }

    /// The length of what opens a comment; 0: it is none.
    std::size_t comment_mark(const std::string &line)
    {
      const std::size_t from = line.find_first_not_of(blank);
      if (from == std::string::npos)
        return 0;
      if (line[from] == '#' || line[from] == '%')
        return from + 1;
      return line.compare(from, 2, "//") == 0 ? from + 2 : 0;
    }

    std::string separator_name(char separator)
    {
      return separator == '\t'  ? "tabs"
             : separator == ' ' ? "blanks"
                                : std::string("'") + separator + "'";
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

  void PrintedDigits::add(const std::string &number)
  {
    int shown = 0, behind = 0, exponent = 0;
    bool is_behind = false;
    for (std::size_t k = 0; k < number.size(); ++k)
    {
      const char c = number[k];
      if (c == '.')
        is_behind = true;
      else if (c == 'e' || c == 'E')
      {
        const std::size_t from = k + (k + 1 < number.size() && number[k + 1] == '+' ? 2 : 1);
        std::from_chars(number.data() + from, number.data() + number.size(), exponent);
        break;
      }
      else if (c >= '0' && c <= '9')
      {
        shown += shown > 0 || c != '0' ? 1 : 0;
        behind += is_behind ? 1 : 0;
      }
    }
    constexpr int fewest = 3; // decimals: 1.0 may be any number
    const std::size_t mantissa = std::min(number.find_first_of("eE"), number.size());
    has_zeros = has_zeros || (behind >= fewest && number[mantissa - 1] == '0');
    decimals = std::max(decimals, behind - exponent);
    significant = std::max(significant, shown);
  }

  double PrintedDigits::rounding(double number) const
  {
    constexpr int fewest = 6;
    const int n = std::max(significant, fewest),
              n_decimals = decimals + (has_zeros ? 0 : n - significant);
    const double fixed = .5 * std::pow(10., -n_decimals);
    return number == 0
               ? fixed
               : std::max(fixed,
                          .5 * std::pow(10., std::floor(std::log10(std::abs(number))) + 1 - n));
  }

  Csv::Csv(const std::string &file, const std::vector<std::string> &required,
           const std::vector<std::string> &may_lack)
      : file_(file), required_(required), may_lack_(may_lack), in_(file)
  {
    read_header();
    for (const std::string &column : required)
      if (!has(column) && std::find(may_lack.begin(), may_lack.end(), column) == may_lack.end())
        fail_without(column);
    for (auto column = columns_.begin(); column != columns_.end(); ++column)
      if (!column->empty() && std::find(columns_.begin(), column, *column) != column)
        fail("two columns are named " + base::shown(*column) + "; rename one of them");
  }

  void Csv::read_header()
  {
    const auto separators = {',', ';', '\t', ' '};
    const auto find_separator = [&](const std::string &header)
    {
      return std::find_if(separators.begin(), separators.end(),
                          [&](char separator) { return names_all(header, separator); });
    };
    bool is_first = true;
    while (std::getline(in_, header_))
    {
      ++line_;
      if (is_first && header_.compare(0, 3, "\xEF\xBB\xBF") == 0)
        header_.erase(0, 3); // a byte order mark, as spreadsheets write it
      is_first = false;
      const std::size_t mark = comment_mark(header_);
      if (mark == 0 && header_.find_first_not_of(blank) != std::string::npos)
        break;
      if (mark == 0)
        continue;
      ++n_comments_;
      if (const auto found = find_separator(header_.substr(mark)); found != separators.end())
      {
        header_.erase(0, mark);
        is_header_comment_ = true;
        break;
      }
    }
    if (!in_.is_open() || in_.bad())
      throw InputError("'" + file_ + "' cannot be read; check its name and folder");
    line_ = std::max<std::size_t>(line_, 1); // of a file without lines the first is wrong
    const auto found = find_separator(header_);
    separator_ = found == separators.end() ? ',' : *found;
    columns_ = split(header_, separator_);
  }

  bool Csv::names_all(const std::string &header, char separator) const
  {
    std::vector<std::string> names = split_line(header, separator);
    for (std::string &name : names)
    {
      unquote(name);
      name = lower(name);
    }
    return std::all_of(required_.begin(), required_.end(),
                       [&](const std::string &column)
                       {
                         const auto has =
                             [&](const std::vector<std::string> &list, const std::string &name)
                         { return std::find(list.begin(), list.end(), name) != list.end(); };
                         return has(may_lack_, column) || has(names, lower(column));
                       });
  }

  std::vector<std::string> Csv::split(const std::string &line, char separator)
  {
    std::vector<std::string> values = split_line(line, separator);
    for (std::string &value : values)
      has_quotes_ = unquote(value) || has_quotes_;
    return values;
  }

  std::vector<std::string> Csv::notes() const
  {
    std::vector<std::string> notes;
    if (separator_ != ',' && columns_.size() > 1)
      notes.push_back("values are separated by " + separator_name(separator_));
    if (has_quotes_)
      notes.emplace_back("values are in quotes");
    for (const std::string &column : required_)
      if (has(column) && columns_[index(column)] != column)
      {
        notes.emplace_back("names of columns are in upper case");
        break;
      }
    if (is_header_comment_)
      notes.emplace_back("a comment line names the columns");
    if (const std::size_t n = n_comments_ - (is_header_comment_ ? 1 : 0); n > 0)
      notes.push_back(std::to_string(n) + (n == 1 ? " comment line is" : " comment lines are") +
                      " left out");
    return notes;
  }

  void Csv::fail_without(const std::string &column) const
  {
    std::string names;
    for (const std::string &one : required_)
      names += (names.empty() ? "" : ",") + one;
    const bool has_names =
        header_.empty() || std::any_of(header_.begin(), header_.end(),
                                       [](unsigned char c) { return std::isalpha(c) != 0; });
    throw InputError("'" + file_ + "' has no column " + column + " in its first line '" +
                     base::shown(header_, 80) + "'" +
                     (has_names ? "" : ": the header line is missing") +
                     "; name the columns there: " + names);
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
      if (comment_mark(text) > 0)
      {
        ++n_comments_;
        continue;
      }
      row_ = split(text, separator_);
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

  double Csv::number(const std::string &column)
  {
    const double number = parse<double>(column, "a finite number");
    digits_[column].add(value(column));
    return number;
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
    const auto exact = std::find(columns_.begin(), columns_.end(), column);
    const auto is_like = [&](const std::string &name) { return lower(name) == lower(column); };
    if (exact == columns_.end() && std::count_if(columns_.begin(), columns_.end(), is_like) == 1)
      return std::find_if(columns_.begin(), columns_.end(), is_like) - columns_.begin();
    return exact - columns_.begin();
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
           (separator_ != ',' && text.find(',') != std::string::npos
                ? "; write decimal points, not commas"
                : "; mend or take out the line"));
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
      const std::vector<std::string> row = split_line(text, ',');
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
} // namespace plumbline::base
