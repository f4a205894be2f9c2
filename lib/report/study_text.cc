#include "report/text_table.h"
#include "report/view.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <set>
#include <utility>

namespace plumbline::report
{
  namespace
  {
    constexpr std::size_t n_columns = summary_columns;
    using Lines = std::vector<std::string>;

    /// The number of a column; that of columns if none is called so.
    std::size_t column(const Table &table, const std::string &head)
    {
      return std::find_if(table.columns.begin(), table.columns.end(),
                          [&](const Column &one) { return one.head == head; }) -
             table.columns.begin();
    }

    /// Of rows that have a method and h, those of the finest levels: a row is left out if the next
    /// one is of the same method and of a smaller h.
    Table of_finest_levels(const Table &table)
    {
      const std::size_t method = column(table, "method"), h = column(table, "h");
      if (std::max(method, h) == table.columns.size())
        return table;
      const auto size = [&](std::size_t row)
      { return std::strtod(table.rows[row][h].text.c_str(), nullptr); };
      Table result;
      result.columns = table.columns;
      for (std::size_t row = 0; row < table.rows.size(); ++row)
        if (row + 1 == table.rows.size() ||
            table.rows[row][method].text != table.rows[row + 1][method].text ||
            size(row + 1) >= size(row))
          result.rows.push_back(table.rows[row]);
      return result;
    }

    /// Head and rows, each in a line, and as many of them as there is room for.
    void add_table(const std::string &head, const Table &table, std::size_t room, Lines &lines)
    {
      constexpr std::size_t unlimited = 10000; // columns: rows are cut, not wrapped
      Lines block = {""};
      if (!head.empty())
        block.push_back(head);
      for (const std::string &row : lines_of(to_text(table, unlimited)))
        block.push_back(fitted(row, n_columns));
      const std::size_t n_rows = table.rows.size(), n_heads = block.size() - n_rows;
      if (n_heads + std::min<std::size_t>(n_rows, 2) > room)
        return;
      block = first_lines(block, room, "rows in the report");
      lines.insert(lines.end(), block.begin(), block.end());
    }

    /// Whether all rows of a method (and scheme) have one verdict.
    bool is_unanimous(const Table &verdicts, const std::vector<Cell> &row,
                      const std::vector<std::size_t> &name, std::size_t verdict)
    {
      return std::all_of(verdicts.rows.begin(), verdicts.rows.end(),
                         [&](const auto &other)
                         {
                           return other[verdict].text == row[verdict].text ||
                                  std::any_of(name.begin(), name.end(),
                                              [&](std::size_t c)
                                              { return other[c].text != row[c].text; });
                         });
    }

    /// "stable: FA, Q1; unstable: OPT", with cases, series or quantities where these differ.
    std::string methods_by_verdict(const Table &verdicts)
    {
      const std::size_t method = column(verdicts, "method"), verdict = column(verdicts, "verdict"),
                        n = verdicts.columns.size(), scheme = column(verdicts, "scheme");
      if (std::max(method, verdict) == n)
        return {};
      const auto varies = [&](std::size_t column)
      {
        return column < n && std::any_of(verdicts.rows.begin(), verdicts.rows.end(),
                                         [&](const auto &row) {
                                           return row[column].text != verdicts.rows[0][column].text;
                                         });
      };
      const bool has_schemes = varies(scheme);
      std::vector<std::size_t> places; // that verdicts may differ in
      for (const char *const head : {"case", "problem", "series", "of"})
        if (varies(column(verdicts, head)))
          places.push_back(column(verdicts, head));
      std::vector<std::size_t> of_name = {method};
      if (has_schemes)
        of_name.push_back(scheme);
      std::vector<std::pair<std::string, std::string>> found;
      std::set<std::string> known;
      for (const auto &row : verdicts.rows)
      {
        const bool is_split = !places.empty() && !is_unanimous(verdicts, row, of_name, verdict);
        std::string place;
        for (const std::size_t one : places)
          place += (place.empty() ? "" : ", ") + row[one].text;
        const std::string name = row[method].text +
                                 (has_schemes ? " with " + row[scheme].text : "") +
                                 (is_split ? " (" + place + ")" : "");
        if (!known.insert(name).second)
          continue;
        const auto same =
            std::find_if(found.begin(), found.end(),
                         [&](const auto &one) { return one.first == row[verdict].text; });
        if (same == found.end())
          found.emplace_back(row[verdict].text, name);
        else
          same->second += ", " + name;
      }
      std::string text;
      for (const auto &[outcome, names] : found)
        text += (text.empty() ? "" : "; ") + outcome + ": " + names;
      if (!text.empty() && text.compare(0, 2, "m-") != 0) // of m-convergent methods
        text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
      return text;
    }

    /// How many of the scene's expectations hold, after those that do not.
    Lines expectation_lines(const StudyResults &results, std::size_t most)
    {
      Lines lines;
      std::size_t n_missed = 0;
      for (const study::Expectation &one : results.expectations)
        if (!one.holds && ++n_missed <= most)
          lines.push_back("not as expected: " + one.subject + ": expected " + one.expected +
                          ", found " + one.found);
      if (n_missed > most)
        lines.push_back("not as expected: " + std::to_string(n_missed - most) +
                        " more in the report");
      if (!results.expectations.empty())
        lines.push_back("expectations: " + std::to_string(results.expectations.size() - n_missed) +
                        " of " + std::to_string(results.expectations.size()) + " hold");
      return lines;
    }

    std::string joined(const Lines &lines)
    {
      std::string text;
      for (const std::string &line : lines)
        text += line + "\n";
      return text;
    }
  } // namespace

  std::string answer_of(const View &view)
  {
    std::string answer = view.answer;
    for (const Statement &one : view.statements)
      answer += (answer.empty() ? "" : " ") + one.words;
    if (answer.empty())
      answer = methods_by_verdict(view.verdicts);
    for (const Part &part : view.parts)
      if (answer.empty())
        answer = methods_by_verdict(part.table);
    return answer;
  }

  std::string study_text(const View &view, const StudyResults &results)
  {
    std::string text = results.scene_name + "\n";
    for (const Part &part : page::with_rows(view.parts))
      if (!part.is_detail)
        text += "\n" + part.head + "\n" + to_text(part.table) +
                (part.words.empty() ? "" : wrapped(part.words, n_columns) + "\n");
    return text;
  }

  std::vector<std::string> short_lines(const std::string &words, std::size_t most,
                                       std::size_t indent)
  {
    Lines lines = lines_of(wrapped(words, n_columns, indent));
    if (lines.size() > most)
    {
      lines.resize(most);
      lines.back() = fitted(lines.back() + " ...", n_columns);
    }
    return lines;
  }

  std::string summary(const Lines &begin, const std::vector<Part> &parts, const Lines &end)
  {
    constexpr std::size_t n_lines = summary_lines, least_share = 9;
    Lines lines;
    for (const std::string &line : begin)
      lines.push_back(fitted(line, n_columns));
    std::vector<Part> shown;
    for (const Part &part : page::with_rows(parts))
      if (!part.is_detail)
        shown.push_back(part);
    for (std::size_t i = 0; i < shown.size() && lines.size() + end.size() < n_lines; ++i)
    {
      const std::size_t room = n_lines - lines.size() - end.size();
      add_table(shown[i].head, of_finest_levels(shown[i].table),
                std::min(room, std::max(least_share, room / (shown.size() - i))), lines);
    }
    return joined(lines) + joined(end);
  }

  std::string study_summary(const View &view, const StudyResults &results, const std::string &files)
  {
    constexpr std::size_t most_verdicts = 9, most_words = 7, most_of_one = 3, most_missed = 2,
                          most_findings = 3, most_of_finding = 2, most_of_advice = 2;
    Lines begin = {heading(results.scene_name, results.purpose)}, end;
    begin.insert(begin.end(), view.constants.begin(), view.constants.end());
    if (!view.verdicts.rows.empty() && view.brief.empty())
      add_table("", view.verdicts, most_verdicts, end);
    end.emplace_back();
    if (const std::size_t n = results.left_out.size(); n > 0)
      end.push_back(fitted("left out by the budget: " + results.left_out.front() +
                               (n > 1 ? " and " + std::to_string(n - 1) + " more" : ""),
                           n_columns));
    for (const std::string &line : expectation_lines(results, most_missed))
      end.push_back(fitted(line, n_columns));
    const auto say = [&](const std::string &text, std::size_t most, std::size_t indent = 0)
    {
      const Lines words = short_lines(text, most, indent);
      end.insert(end.end(), words.begin(), words.end());
    };
    const std::size_t n_findings = view.findings.size();
    for (std::size_t i = 0; i < std::min(most_findings, n_findings); ++i)
      say("- " + view.findings[i], most_of_finding, 2);
    if (n_findings > most_findings)
      end.push_back("  and " + std::to_string(n_findings - most_findings) +
                    " more findings in the report");
    end.push_back("report: " + files);
    if (const std::string answer = answer_of(view); !answer.empty())
      end.emplace_back();
    if (view.statements.empty())
      say(answer_of(view), most_words);
    for (const Statement &one : view.statements)
      say(one.words, most_of_one);
    for (const std::string &one : view.advice)
      say(one, most_of_advice);
    return summary(begin, view.brief.empty() ? view.parts : view.brief, end);
  }
} // namespace plumbline::report
