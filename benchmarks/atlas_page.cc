// Results of benchmarks/atlas on one page: for each scene the cheapest method at each accuracy, the
// Pareto front, and who stalls or fails; then the choice of solver and operator.
// Run: build/release/benchmarks/atlas_page FOLDER, which writes index.html and atlas.csv there.

#include "atlas_survey.h"

#include "base/error.h"
#include "report/charts.h"
#include "report/formats.h"
#include "report/page_parts.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <utility>

namespace plumbline::atlas
{
  using report::escape_html;
  namespace page = report::page;

  namespace
  {
    std::string join(const std::vector<std::string> &names)
    {
      std::string text;
      for (const std::string &name : names)
        text += (text.empty() ? "" : ", ") + escape_html(name);
      return text.empty() ? "–" : text;
    }

    /// The one problem of a scene that stands for it in the overview.
    Question main_question(const Entry &entry)
    {
      return {&entry.results, report::telling_problem(entry.results), ""};
    }

    bool has_errors(const Entry &entry)
    {
      const auto &runs = entry.results.runs;
      return std::any_of(runs.begin(), runs.end(),
                         [&](const study::Run &run)
                         { return std::isfinite(relative_error(entry.results, run)); });
    }

    // ---- the methods over all scenes ------------------------------------------------------------

    std::string tally_table(const std::vector<Question> &questions)
    {
      const auto tallies = tally(questions);
      report::Table table;
      table.columns = {"method",    "cases", "converges",    "stalls",
                       "undecided", "fails", "on the front", "on it, but stalling"};
      for (const double target : targets)
        table.columns.emplace_back("cheapest at " + report::short_power(target));
      std::vector<std::string> order;
      for (const auto &[method, one] : tallies)
        order.push_back(method);
      std::stable_sort(order.begin(), order.end(),
                       [&](const std::string &a, const std::string &b)
                       { return tallies.at(a).n_front > tallies.at(b).n_front; });
      for (const std::string &method : order)
      {
        const Tally &one = tallies.at(method);
        const auto of = [](const auto &map, auto key)
        { return report::count_cell(map.count(key) > 0 ? map.at(key) : 0); };
        std::vector<report::Cell> row = {report::text_cell(method),
                                         report::count_cell(one.n),
                                         of(one.n_outcome, study::Outcome::converges),
                                         of(one.n_outcome, study::Outcome::stalls),
                                         of(one.n_outcome, study::Outcome::undecided),
                                         of(one.n_outcome, study::Outcome::failed),
                                         report::count_cell(one.n_front),
                                         report::count_cell(one.n_front_stalling)};
        for (const double target : targets)
          row.push_back(of(one.n_cheapest, target));
        table.rows.push_back(row);
      }
      return "<div class=\"wide\">" + to_html(table) + "</div>\n";
    }

    /// "ipa_ac (30 cases): on the front most often IPA-AC-R2 (28), Q2 (20); ..."
    std::string in_short(const std::vector<Entry> &entries)
    {
      constexpr std::size_t n_named = 5;
      std::map<std::string, std::vector<Question>> groups;
      for (const Entry &entry : entries)
        if (has_errors(entry))
          for (const report::Case &one : report::cases(entry.results))
            groups[entry.group].push_back({&entry.results, one.problem, one.series});
      std::string text;
      for (const auto &[group, questions] : groups)
      {
        std::vector<std::pair<std::size_t, std::string>> ranks;
        for (const auto &[method, one] : tally(questions))
          ranks.emplace_back(one.n_front, method);
        std::sort(ranks.rbegin(), ranks.rend());
        std::vector<std::string> names;
        for (std::size_t i = 0; i < std::min(n_named, ranks.size()) && ranks[i].first > 0; ++i)
          names.push_back(ranks[i].second + " (" + std::to_string(ranks[i].first) + ")");
        text += "<li><b>scenes/" + escape_html(group) + "</b>, " +
                std::to_string(questions.size()) +
                " cases; on the front most often, and not stalling: " + join(names) + "</li>\n";
      }
      return "<ul>\n" + text + "</ul>\n";
    }

    // ---- one row a question ---------------------------------------------------------------------

    std::string choice_cell(const Question &question, double target)
    {
      const study::Run *run = cheapest(question, target);
      if (run == nullptr)
        return "<td class=\"absent\">–</td>";
      const bool is_sure = outcome_of(question, run->method) == study::Outcome::converges;
      return std::string("<td class=\"") + (is_sure ? "converges" : "undecided") +
             "\" title=\"relative error " +
             report::rounded_error(relative_error(*question.results, *run)) + ", " +
             escape_html(run->series) + "\"><b>" + escape_html(run->method) + "</b><small>" +
             report::rounded_seconds(run->cost.seconds()) + ", h = " + report::rounded(run->h) +
             "</small></td>";
    }

    std::string head(const std::string &first)
    {
      std::string text = "<tr><th>" + first + "</th>";
      for (const double target : targets)
        text += "<th>" + report::short_power(target) + "</th>";
      return text + "<th>on the front, cheap to dear</th><th>stalls</th><th>fails</th></tr>\n";
    }

    std::string row(const std::string &first, const Question &question)
    {
      std::string text = "<tr><th class=\"method\">" + first + "</th>";
      for (const double target : targets)
        text += choice_cell(question, target);
      const auto failed = with_outcome(question, study::Outcome::failed);
      std::vector<std::string> front = methods_on_front(question);
      for (std::string &method : front)
        method += is_stalling(question, method) ? " ✗" : "";
      return text + "<td class=\"front\">" + join(front) + "</td><td class=\"names\">" +
             join(with_outcome(question, study::Outcome::stalls)) + "</td><td" +
             (failed.empty() ? "" : " class=\"failed\"") + ">" + join(failed) + "</td></tr>\n";
    }

    std::string wide(const std::string &rows)
    {
      return "<div class=\"wide\"><table class=\"verdicts\">\n" + rows + "</table></div>\n";
    }

    std::string overview(const std::vector<Entry> &entries)
    {
      std::string text = head("scene");
      for (const Entry &entry : entries)
      {
        const std::string name = escape_html(entry.group + "/" + entry.name);
        if (!entry.refusal.empty())
          text += "<tr><th class=\"method\">" + name + "</th><td class=\"failed\" colspan=\"8\">" +
                  "refused: " + escape_html(entry.refusal) + "</td></tr>\n";
        else if (has_errors(entry))
          text += row("<a href=\"#" + entry.group + "-" + entry.name + "\">" + name + "</a>" +
                          (entry.results.is_complete ? "" : " <small>in part</small>"),
                      main_question(entry));
        else
          text += "<tr><th class=\"method\">" + name +
                  "</th><td class=\"absent\" colspan=\"8\">no errors to compare</td></tr>\n";
      }
      return wide(text);
    }

    /// Work-precision diagrams against CPU time, memory and pairs, and all cases in a table.
    std::string details(const Entry &entry)
    {
      const std::string folder = entry.folder.generic_string();
      std::string pictures, rows = head("case");
      std::map<report::ChartKind, bool> is_shown;
      for (const report::Chart &chart : report::list_charts(entry.results))
        if ((chart.kind == report::ChartKind::work_precision ||
             chart.kind == report::ChartKind::memory || chart.kind == report::ChartKind::pairs) &&
            chart.problem == report::telling_problem(entry.results) &&
            !std::exchange(is_shown[chart.kind], true))
          pictures += "<figure><img loading=\"lazy\" style=\"width:100%\" alt=\"" +
                      escape_html(chart.title) + "\" src=\"" + folder + "/charts/" + chart.name +
                      ".svg\"></figure>\n";
      for (const report::Case &one : report::cases(entry.results))
        rows += row(escape_html(one.title()), {&entry.results, one.problem, one.series});
      std::string left_out;
      if (!entry.results.is_complete)
        left_out = page::paragraph("Its time was over before all methods and levels were run.");
      if (!entry.results.left_out.empty())
        left_out += page::paragraph(std::to_string(entry.results.left_out.size()) +
                                    " solves were left out, being dearer than the budget.");
      return "<h3 id=\"" + entry.group + "-" + entry.name + "\"><a href=\"" + folder +
             "/report.html\">" + escape_html(entry.group + "/" + entry.name) + "</a></h3>\n" +
             page::paragraph(entry.results.purpose) + "<div class=\"grid\">\n" + pictures +
             "</div>\n" + left_out +
             page::folded("All cases (" + std::to_string(report::cases(entry.results).size()) + ")",
                          wide(rows));
    }

    // ---- solvers and operators ------------------------------------------------------------------

    /// CsrMatrix: method and level of one scene; columns: its choices.
    std::string choices(const std::vector<Entry> &entries, const std::string &scene)
    {
      std::vector<const Entry *> columns;
      for (const Entry &entry : entries)
        if (entry.group == scene)
          columns.push_back(&entry);
      std::string text = "<tr><th>" + escape_html(scene) + "</th>";
      std::vector<const study::Run *> runs; // of all choices, each method and level once
      for (const Entry *column : columns)
      {
        text += "<th>" + escape_html(column->name) + "</th>";
        for (const study::Run &run : column->results.runs)
          if (std::none_of(runs.begin(), runs.end(),
                           [&](const study::Run *other)
                           { return other->method == run.method && other->h == run.h; }))
            runs.push_back(&run);
      }
      text += "</tr>\n";
      for (const study::Run *row_run : runs)
      {
        std::vector<const study::Run *> cells;
        for (const Entry *column : columns)
        {
          const auto &all = column->results.runs;
          const auto found = std::find_if(all.begin(), all.end(),
                                          [&](const study::Run &run) {
                                            return run.method == row_run->method &&
                                                   run.h == row_run->h && run.failure.empty();
                                          });
          cells.push_back(found == all.end() ? nullptr : &*found);
        }
        double least = 0;
        for (const study::Run *cell : cells)
          if (cell != nullptr && (least == 0 || cell->cost.seconds() < least))
            least = cell->cost.seconds();
        text += "<tr><th class=\"method\">" + escape_html(row_run->method) +
                ", h = " + report::rounded(row_run->h) + "<br><small>" +
                std::to_string(row_run->cost.n_unknowns) + " unknowns</small></th>";
        for (const study::Run *cell : cells)
          text += cell == nullptr
                      ? "<td class=\"absent\">–</td>"
                      : std::string("<td class=\"") +
                            (cell->cost.seconds() <= 1.1 * least ? "converges" : "") +
                            "\" title=\"" + escape_html(cell->diagnostics.operator_backend) +
                            "\"><b>" + report::rounded_seconds(cell->cost.seconds()) +
                            "</b><small>" +
                            report::rounded(static_cast<double>(cell->cost.peak_bytes) / 1e6) +
                            " MB, " + std::to_string(cell->cost.n_iterations) +
                            " iterations</small></td>";
        text += "</tr>\n";
      }
      return wide(text);
    }

    std::string solvers(const std::vector<Entry> &entries)
    {
      std::vector<std::string> scenes;
      for (const Entry &entry : entries)
        if (std::count(scenes.begin(), scenes.end(), entry.group) == 0)
          scenes.push_back(entry.group);
      std::string text;
      for (const std::string &scene : scenes)
        text += choices(entries, scene);
      return text;
    }

    std::string csv(const std::vector<Entry> &entries)
    {
      report::Table table;
      table.columns = {"scene",          "case",  "target",     "method", "h",
                       "relative error", "CPU s", "peak bytes", "pairs"};
      for (const Entry &entry : entries)
        if (has_errors(entry))
          for (const report::Case &one : report::cases(entry.results))
            for (const double target : targets)
            {
              const Question question{&entry.results, one.problem, one.series};
              if (const study::Run *run = cheapest(question, target))
                table.rows.push_back({report::text_cell(entry.group + "/" + entry.name),
                                      report::text_cell(one.title()), report::number_cell(target),
                                      report::text_cell(run->method), report::number_cell(run->h),
                                      report::number_cell(relative_error(entry.results, *run)),
                                      report::number_cell(run->cost.seconds()),
                                      report::count_cell(run->cost.peak_bytes),
                                      report::count_cell(run->cost.n_bonds)});
            }
      return to_csv(table);
    }

    std::string header(const std::vector<Entry> &entries, std::size_t n_cases)
    {
      std::size_t n_runs = 0;
      std::string machine;
      for (const Entry &entry : entries)
      {
        n_runs += entry.results.runs.size();
        for (const char *key : {"processor", "version"})
          if (machine.find(key) == std::string::npos && entry.results.provenance.count(key) > 0)
            machine += std::string("<li>") + key + ": " +
                       escape_html(entry.results.provenance.at(key)) + "</li>";
      }
      return "<header>\n<div class=\"brand\">Plumbline atlas</div>\n<h1>What a digit costs, and "
             "who fails</h1>\n<p class=\"purpose\">Every shipped scene by every method that can do "
             "it. Which method is the cheapest for the accuracy you need?</p>\n<ul "
             "class=\"facts\"><li>" +
             std::to_string(entries.size()) + " scenes</li><li>" + std::to_string(n_cases) +
             " cases</li><li>" + std::to_string(n_runs) + " solves</li>" + machine +
             "</ul>\n<nav><a href=\"#short\">In short</a><a href=\"#overview\">Overview</a><a "
             "href=\"#solvers\">Solvers and operators</a><a "
             "href=\"#scenes\">Scenes</a></nav>\n</header>\n";
    }
  } // namespace

  void write_page(const fs::path &atlas)
  {
    const std::vector<Entry> entries = read_entries(atlas, "scenes");
    if (entries.empty())
      throw InputError("'" + atlas.string() +
                       "' has no finished scenes; run benchmarks/atlas first");
    std::vector<Question> questions;
    std::string scenes;
    for (const Entry &entry : entries)
      if (has_errors(entry))
      {
        for (const report::Case &one : report::cases(entry.results))
          questions.push_back({&entry.results, one.problem, one.series});
        scenes += details(entry);
      }
    const std::string how = page::paragraph(
        "Errors are relative to the largest value of the solution, in the norm that decides each "
        "scene's verdicts; costs are CPU seconds of setup and solve on one thread. Within 20 % "
        "of the cheapest the method with the fewest unknowns is named. A method is on "
        "the (Pareto) front of a case if one of its runs errs by at most a tenth and no other run "
        "is as accurate for nine tenths of its time. A method that stalls or fails may be on it "
        "(✗) where little accuracy is asked for, but is never named as the cheapest. Green: it "
        "converges; yellow: its sweep is too short to tell.");
    const std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
        "name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>Plumbline "
        "atlas</title>\n<style>" +
        std::string(page::style_sheet) +
        "body { max-width: 1700px; } td.front { min-width: 17rem; } td.names { min-width: 10rem; "
        "}</style>\n</head>\n<body>\n" +
        header(entries, questions.size()) + "<main>\n" +
        page::section("short", "In short", how + in_short(entries) + tally_table(questions)) +
        page::section("overview", "The cheapest method for a relative error",
                      page::paragraph("Of each scene the problem that tells most, the best of its "
                                      "series; all cases stand further down.") +
                          overview(entries)) +
        page::section(
            "solvers", "The choice of solver and operator",
            page::paragraph("The same discrete problem, other ways to its solution. Green: "
                            "within a tenth of the fastest.") +
                solvers(read_entries(atlas, "solvers"))) +
        page::section("scenes", "Scenes", scenes) + "</main>\n</body>\n</html>\n";
    report::write_file(atlas / "index.html", html);
    report::write_file(atlas / "atlas.csv", csv(entries));
    std::cout << "atlas: " << (atlas / "index.html").string() << '\n';
  }
} // namespace plumbline::atlas

int main(int argc, char **argv)
{
  if (argc != 2)
  {
    std::cerr << "usage: atlas_page FOLDER\n";
    return 2;
  }
  try
  {
    plumbline::atlas::write_page(argv[1]);
  }
  catch (const plumbline::InputError &error)
  {
    std::cerr << "atlas_page: " << error.what() << '\n';
    return 2;
  }
}
