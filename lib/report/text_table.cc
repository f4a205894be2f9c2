#include "report/text_table.h"

#include <algorithm>

namespace plumbline::report
{
  namespace
  {
    /// Characters of a text in UTF-8.
    std::size_t length(const std::string &text)
    {
      return static_cast<std::size_t>(
          std::count_if(text.begin(), text.end(),
                        [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
    }
  } // namespace

  Table without_empty_columns(const Table &table)
  {
    if (table.rows.empty())
      return table; // it is still a table, see page::is_shown
    Table result;
    result.caption = table.caption;
    result.rows.resize(table.rows.size());
    const std::string empty = empty_cell().text;
    for (std::size_t j = 0; j < table.columns.size(); ++j)
    {
      if (std::all_of(table.rows.begin(), table.rows.end(),
                      [&](const auto &row) { return row[j].text == empty; }))
        continue;
      result.columns.push_back(table.columns[j]);
      for (std::size_t i = 0; i < table.rows.size(); ++i)
        result.rows[i].push_back(table.rows[i][j]);
    }
    return result;
  }

  Cell known(bool is, const Cell &cell)
  {
    return is ? cell : empty_cell();
  }

  std::string wrapped(const std::string &words, std::size_t width, std::size_t indent)
  {
    std::string text = words;
    for (std::size_t start = 0; text.size() - start > width;)
    {
      const std::size_t blank = text.rfind(' ', start + width),
                        first = start == 0 ? 0 : start + indent;
      if (blank == std::string::npos || blank <= first)
        break;
      text.replace(blank, 1, "\n" + std::string(indent, ' '));
      start = blank + 1;
    }
    return text;
  }

  std::string heading(const std::string &scene, const std::string &purpose)
  {
    return purpose.empty() ? scene : scene + ": " + purpose;
  }

  std::string fitted(const std::string &line, std::size_t n_columns)
  {
    const std::string more = " ...";
    // continuation bytes of UTF-8 take no column
    std::size_t n = 0, end = 0;
    for (std::size_t i = 0; i < line.size(); ++i)
      if ((static_cast<unsigned char>(line[i]) & 0xC0U) != 0x80U && ++n == n_columns - more.size())
        end = i;
    if (n <= n_columns)
      return line;
    const std::size_t blank = line.rfind(' ', end);
    return line.substr(0, blank == std::string::npos ? end : blank) + more;
  }

  std::vector<std::string> lines_of(const std::string &text)
  {
    std::vector<std::string> lines;
    for (std::size_t start = 0; start < text.size();)
    {
      const std::size_t end = std::min(text.find('\n', start), text.size());
      lines.push_back(text.substr(start, end - start));
      start = end + 1;
    }
    return lines;
  }

  std::vector<std::string> first_lines(std::vector<std::string> lines, std::size_t room,
                                       const std::string &where)
  {
    if (const std::size_t n = lines.size(); n > room)
    {
      lines.resize(room - 1);
      lines.push_back("... " + std::to_string(n + 1 - room) + " more " + where);
    }
    return lines;
  }

  std::string to_text(const Table &table, std::size_t terminal)
  {
    std::vector<std::size_t> width;
    for (std::size_t j = 0; j < table.columns.size(); ++j)
    {
      width.push_back(length(table.columns[j].head));
      for (const auto &row : table.rows)
        width[j] = std::max(width[j], length(row[j].text));
    }
    // the last column is wrapped, in lines as wide as is left of the terminal
    std::size_t indent = 0;
    for (std::size_t j = 0; j + 1 < width.size(); ++j)
      indent += width[j] + 2;
    const std::size_t room = std::max<std::size_t>(40, terminal - std::min(terminal, indent));
    std::string text;
    const auto add = [&](const std::string &cell, std::size_t j)
    {
      const bool is_last = j + 1 == width.size();
      text += is_last ? wrapped(cell, room, indent) + "\n"
                      : cell + std::string(width[j] + 2 - length(cell), ' ');
    };
    for (std::size_t j = 0; j < width.size(); ++j)
      add(table.columns[j].head, j);
    for (const auto &row : table.rows)
      for (std::size_t j = 0; j < width.size(); ++j)
        add(row[j].text, j);
    return text;
  }
} // namespace plumbline::report
