#include "report/formats.h"

#include <cmath>
#include <cstdio>
#include <utility>

namespace plumbline::report
{
  namespace
  {
    const std::string missing = "–";

    std::string print(const char *format, double value)
    {
      char buffer[64];
      std::snprintf(buffer, sizeof buffer, format, value);
      return buffer;
    }

    /// 1.2e-05 as 1.2e-5, 1e+06 as 1e6.
    std::string short_exponent(const std::string &number)
    {
      const std::size_t e = number.find('e');
      if (e == std::string::npos)
        return number;
      const int power = std::stoi(number.substr(e + 1));
      return number.substr(0, e) + "e" + std::to_string(power);
    }

    std::string replace(const std::string &text,
                        const std::vector<std::pair<std::string, std::string>> &rules)
    {
      std::string result;
      for (std::size_t i = 0; i < text.size();)
      {
        bool is_found = false;
        for (const auto &[from, to] : rules)
          if (text.compare(i, from.size(), from) == 0)
          {
            result += to;
            i += from.size();
            is_found = true;
            break;
          }
        if (!is_found)
          result += text[i++];
      }
      return result;
    }
  } // namespace

  std::string exact(double value)
  {
    return std::isfinite(value) ? print("%.17g", value) : "";
  }

  std::string rounded(double value)
  {
    if (!std::isfinite(value))
      return missing;
    const bool is_short_integer = std::abs(value) < 1e5 && value == std::trunc(value);
    return short_exponent(print(is_short_integer ? "%.5g" : "%.4g", value));
  }

  std::string rounded_error(double value)
  {
    if (value == 0)
      return "0";
    return std::isfinite(value) ? short_exponent(print("%.3e", value)) : missing;
  }

  std::string rounded_with_uncertainty(double value, double uncertainty)
  {
    if (!std::isfinite(value) || !std::isfinite(uncertainty))
      return rounded(value);
    return rounded(value) + " ± " + short_exponent(print("%.2g", uncertainty));
  }

  std::string short_power(double value)
  {
    std::string number = print("%.2e", value);
    const std::size_t e = number.find('e');
    if (!std::isfinite(value) || e == std::string::npos)
      return missing;
    std::string digits = number.substr(0, e);
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.')
      digits.pop_back();
    return short_exponent(digits + number.substr(e));
  }

  std::string rounded_seconds(double seconds)
  {
    if (!std::isfinite(seconds) || seconds < 0)
      return missing;
    const auto digits = [](double value)
    {
      // 99.6 has two digits before the point already; "%.2g" would give it an exponent.
      if (value >= 99.5)
        return print("%.0f", 10 * std::round(value / 10));
      return print("%.2g", value);
    };
    // A unit is left where its figure would have four digits before the point, or three behind.
    if (seconds < 1e-4)
      return digits(1e6 * seconds) + " µs";
    if (seconds < .1)
      return digits(1e3 * seconds) + " ms";
    if (seconds < 1e4)
      return digits(seconds) + " s";
    return digits(seconds / 3600) + " h";
  }

  std::string slug(const std::string &name)
  {
    static const std::vector<std::pair<std::string, std::string>> greek = {
        {"δ", "delta"}, {"κ", "kappa"}, {"ν", "nu"},    {"ε", "epsilon"}, {"λ", "lambda"},
        {"μ", "mu"},    {"Δ", "delta"}, {"∞", "inf"},   {"α", "alpha"},   {"β", "beta"},
        {"γ", "gamma"}, {"σ", "sigma"}, {"ω", "omega"}, {"θ", "theta"},   {"ξ", "xi"}};
    std::string result;
    for (const char c : replace(name, greek))
    {
      const bool is_upper = c >= 'A' && c <= 'Z';
      const bool is_kept = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.';
      if (is_upper || is_kept)
        result += is_upper ? static_cast<char>(c - 'A' + 'a') : c;
      else if (!result.empty() && result.back() != '-')
        result += '-';
    }
    const std::size_t from = result.find_first_not_of(".-");
    if (from == std::string::npos)
      return "all";
    return result.substr(from, result.find_last_not_of(".-") - from + 1);
  }

  std::string escape_html(const std::string &text)
  {
    return replace(
        text, {{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}, {"'", "&#39;"}});
  }

  std::string escape_latex(const std::string &text)
  {
    static const std::vector<std::pair<std::string, std::string>> rules = {
        {"\\", "\\textbackslash{}"},
        {"{", "\\{"},
        {"}", "\\}"},
        {"$", "\\$"},
        {"&", "\\&"},
        {"#", "\\#"},
        {"%", "\\%"},
        {"_", "\\_"},
        {"^", "\\textasciicircum{}"},
        {"~", "\\textasciitilde{}"},
        {"<", "$<$"},
        {">", "$>$"},
        {"|", "$|$"},
        {"–", "--"},
        {"±", "$\\pm$"},
        {"×", "$\\times$"},
        {"≤", "$\\le$"},
        {"≥", "$\\ge$"},
        {"∞", "$\\infty$"},
        {"→", "$\\to$"},
        {"√", "$\\surd$"},
        {"α", "$\\alpha$"},
        {"β", "$\\beta$"},
        {"γ", "$\\gamma$"},
        {"δ", "$\\delta$"},
        {"ε", "$\\varepsilon$"},
        {"κ", "$\\kappa$"},
        {"λ", "$\\lambda$"},
        {"μ", "$\\mu$"},
        {"ν", "$\\nu$"},
        {"ξ", "$\\xi$"},
        {"σ", "$\\sigma$"},
        {"ω", "$\\omega$"},
        {"\n", " "},
    };
    return replace(text, rules);
  }

  std::string quote_csv(const std::string &text)
  {
    const bool has_outer_blank = !text.empty() && (text.front() == ' ' || text.back() == ' ');
    if (text.find_first_of(",\"\n\r") == std::string::npos && !has_outer_blank)
      return text;
    return "\"" + replace(text, {{"\"", "\"\""}}) + "\"";
  }

  Cell text_cell(const std::string &text)
  {
    return {{text}, text, false};
  }

  Cell number_cell(double value)
  {
    return {{exact(value)}, rounded(value), true};
  }

  Cell error_cell(double value)
  {
    return {{exact(value)}, rounded_error(value), true};
  }

  Cell rate_cell(double value)
  {
    return {{exact(value)}, std::isfinite(value) ? print("%.3f", value) : missing, true};
  }

  Cell count_cell(std::uint64_t value)
  {
    return {{std::to_string(value)}, std::to_string(value), true};
  }

  Cell uncertain_cell(double value, double uncertainty)
  {
    return {{exact(value), exact(uncertainty)}, rounded_with_uncertainty(value, uncertainty), true};
  }

  Cell uncertain_error_cell(double value, double uncertainty)
  {
    Cell cell = error_cell(value);
    cell.csv.push_back(exact(uncertainty));
    if (std::isfinite(value) && std::isfinite(uncertainty))
      cell.text += " ± " + short_exponent(print("%.1e", uncertainty));
    return cell;
  }

  Cell empty_cell()
  {
    return {{""}, missing, true};
  }

  std::string to_csv(const Table &table)
  {
    std::string text, separator;
    for (const Column &column : table.columns)
      for (const std::string &name : column.csv)
        text += std::exchange(separator, ",") + quote_csv(name);
    text += "\n";
    for (const std::vector<Cell> &row : table.rows)
    {
      separator.clear();
      for (const Cell &cell : row)
        for (const std::string &field : cell.csv)
          text += std::exchange(separator, ",") + quote_csv(field);
      text += "\n";
    }
    return text;
  }

  std::string to_markdown(const Table &table)
  {
    const auto clean = [](const std::string &text) {
      return replace(text, {{"|", "\\|"}, {"\n", " "}, {"<", "&lt;"}});
    };
    std::string text = table.caption.empty() ? "" : clean(table.caption) + "\n\n";
    std::string rule;
    for (std::size_t j = 0; j < table.columns.size(); ++j)
    {
      const Column &column = table.columns[j];
      text += "| " + clean(column.group + (column.group.empty() ? "" : ", ") + column.head) + " ";
      rule += !table.rows.empty() && table.rows.front()[j].is_number ? "|---:" : "|:---";
    }
    text += "|\n" + rule + "|\n";
    for (const std::vector<Cell> &row : table.rows)
    {
      for (const Cell &cell : row)
        text += "| " + clean(cell.text) + " ";
      text += "|\n";
    }
    return text;
  }

  std::string to_latex(const Table &table)
  {
    const auto entry = [](const Cell &cell)
    {
      const std::size_t e = cell.text.find('e');
      if (!cell.is_number || e == std::string::npos || cell.text.find(' ') != std::string::npos)
        return escape_latex(cell.text);
      return "$" + cell.text.substr(0, e) + "\\times10^{" + cell.text.substr(e + 1) + "}$";
    };
    std::string format;
    for (std::size_t j = 0; j < table.columns.size(); ++j)
      format += !table.rows.empty() && table.rows.front()[j].is_number ? 'r' : 'l';

    std::string text = "% " + replace(table.caption, {{"\n", " "}}) +
                       "\n% needs \\usepackage{booktabs}\n\\begin{tabular}{" + format +
                       "}\n\\toprule\n";
    std::string separator;
    for (const Column &column : table.columns)
      text += std::exchange(separator, " & ") + escape_latex(column.head);
    text += " \\\\\n\\midrule\n";
    for (const std::vector<Cell> &row : table.rows)
    {
      separator.clear();
      for (const Cell &cell : row)
        text += std::exchange(separator, " & ") + entry(cell);
      text += " \\\\\n";
    }
    return text + "\\bottomrule\n\\end{tabular}\n";
  }
} // namespace plumbline::report
