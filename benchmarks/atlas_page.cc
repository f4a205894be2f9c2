// Results of benchmarks/atlas on one page: for each scene the cheapest method at each accuracy, the
// Pareto front, and who stalls or fails; then the choice of solver and operator.
// Run: build/release/benchmarks/atlas_page FOLDER, which writes index.html and atlas.csv there.

#include "atlas_survey.h"
#include "templates.h"

#include "base/error.h"
#include "report/page_parts.h"
#include "report/statics_view.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <utility>

namespace plumbline::atlas
{
  using report::Data;

  namespace
  {
    std::string join(const std::vector<std::string> &names)
    {
      std::string text;
      for (const std::string &name : names)
        text += (text.empty() ? "" : ", ") + name;
      return text.empty() ? "–" : text;
    }

    /// The one problem of a scene that stands for it in the overview.
    Question main_question(const Entry &entry)
    {
      return {&entry.results, report::telling_problem(entry.results), ""};
    }

    bool has_errors(const Entry &entry)
    {
      const auto &runs = entry.results.records;
      return std::any_of(runs.begin(), runs.end(),
                         [&](const study::Record &run)
                         { return std::isfinite(relative_error(entry.results, run)); });
    }

    // ---- the methods over all scenes ------------------------------------------------------------

    report::Table tally_table(const std::vector<Question> &questions)
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
      return table;
    }

    /// "ipa_ac (30 cases): on the front most often IPA-AC-R2 (28), Q2 (20); ..."
    Data in_short(const std::vector<Entry> &entries)
    {
      constexpr std::size_t n_named = 5;
      std::map<std::string, std::vector<Question>> groups;
      for (const Entry &entry : entries)
        if (has_errors(entry))
          for (const report::Case &one : report::cases(entry.results))
            groups[entry.group].push_back({&entry.results, one.problem, one.series});
      Data list = Data::array();
      for (const auto &[group, questions] : groups)
      {
        std::vector<std::pair<std::size_t, std::string>> ranks;
        for (const auto &[method, one] : tally(questions))
          ranks.emplace_back(one.n_front, method);
        std::sort(ranks.rbegin(), ranks.rend());
        std::vector<std::string> names;
        for (std::size_t i = 0; i < std::min(n_named, ranks.size()) && ranks[i].first > 0; ++i)
          names.push_back(ranks[i].second + " (" + std::to_string(ranks[i].first) + ")");
        list.push_back({{"group", group}, {"n_cases", questions.size()}, {"front", join(names)}});
      }
      return list;
    }

    // ---- one row a question ---------------------------------------------------------------------

    Data choice(const Question &question, double target)
    {
      const study::Record *run = cheapest(question, target);
      if (run == nullptr)
        return {{"is_absent", true}};
      const bool is_sure = outcome_of(question, run->key.method) == study::Outcome::converges;
      return {{"is_absent", false},
              {"look", is_sure ? "converges" : "undecided"},
              {"error", report::rounded_error(relative_error(*question.results, *run))},
              {"series", run->key.series},
              {"method", run->key.method},
              {"seconds", report::rounded_seconds(run->cost.seconds())},
              {"h", report::rounded(run->key.h)}};
    }

    /// HTML: the cheapest at each target, then who is on the front, stalls, fails.
    std::string cells(const Question &question)
    {
      Data choices = Data::array();
      for (const double target : targets)
        choices.push_back(choice(question, target));
      const auto failed = with_outcome(question, study::Outcome::failed);
      std::vector<std::string> front = methods_on_front(question);
      for (std::string &method : front)
        method += is_stalling(question, method) ? " ✗" : "";
      return report::fill_text(benchmarks::templates().at("cheapest"),
                               {{"choices", choices},
                                {"front", join(front)},
                                {"stalling", join(with_outcome(question, study::Outcome::stalls))},
                                {"is_failing", !failed.empty()},
                                {"failing", join(failed)}});
    }

    std::string id_of(const Entry &entry)
    {
      return entry.group + "-" + entry.name;
    }

    Data overview(const std::vector<Entry> &entries)
    {
      Data list = Data::array();
      for (const Entry &entry : entries)
      {
        const bool is_compared = entry.refusal.empty() && has_errors(entry);
        list.push_back({{"name", entry.group + "/" + entry.name},
                        {"refusal", entry.refusal},
                        {"is_without_errors", entry.refusal.empty() && !is_compared},
                        {"question", is_compared ? Data{{"id", id_of(entry)},
                                                        {"is_complete", entry.results.is_complete},
                                                        {"cells", cells(main_question(entry))}}
                                                 : Data()}});
      }
      return list;
    }

    /// Work-precision diagrams against CPU time, memory and pairs, and all cases in a table.
    Data details(const Entry &entry)
    {
      const std::string folder = entry.folder.generic_string();
      Data pictures = Data::array(), all = Data::array();
      for (const report::Gallery &gallery : report::statics_galleries(entry.results))
        if ((gallery.id == "work" || gallery.id == "memory" || gallery.id == "pairs") &&
            !gallery.charts.empty()) // the first is of the telling problem
          pictures.push_back({{"title", gallery.charts.front().plot.title},
                              {"file", folder + "/charts/" + gallery.charts.front().plot.file}});
      for (const report::Case &one : report::cases(entry.results))
        all.push_back(
            {{"title", one.title()}, {"cells", cells({&entry.results, one.problem, one.series})}});
      const std::size_t n_left_out = entry.results.left_out.size(), n_cases = all.size();
      return {{"id", id_of(entry)},
              {"folder", folder},
              {"name", entry.group + "/" + entry.name},
              {"purpose", entry.results.purpose},
              {"pictures", std::move(pictures)},
              {"is_complete", entry.results.is_complete},
              {"n_left_out", n_left_out == 0 ? Data() : Data(n_left_out)},
              {"n_cases", n_cases},
              {"cases", std::move(all)}};
    }

    // ---- solvers and operators ------------------------------------------------------------------

    /// Rows: method and level of one scene; columns: its choices.
    Data choices(const std::vector<Entry> &entries, const std::string &scene)
    {
      std::vector<const Entry *> columns;
      for (const Entry &entry : entries)
        if (entry.group == scene)
          columns.push_back(&entry);
      Data heads = Data::array(), rows = Data::array();
      std::vector<const study::Record *> runs; // of all choices, each method and level once
      for (const Entry *column : columns)
      {
        heads.push_back(column->name);
        for (const study::Record &run : column->results.records)
          if (std::none_of(runs.begin(), runs.end(),
                           [&](const study::Record *other) {
                             return other->key.method == run.key.method &&
                                    other->key.h == run.key.h;
                           }))
            runs.push_back(&run);
      }
      for (const study::Record *row_run : runs)
      {
        std::vector<const study::Record *> found;
        double least = 0;
        for (const Entry *column : columns)
        {
          const auto &all = column->results.records;
          const auto run = std::find_if(all.begin(), all.end(),
                                        [&](const study::Record &one)
                                        {
                                          return one.key.method == row_run->key.method &&
                                                 one.key.h == row_run->key.h && one.failure.empty();
                                        });
          found.push_back(run == all.end() ? nullptr : &*run);
          if (found.back() != nullptr && (least == 0 || run->cost.seconds() < least))
            least = run->cost.seconds();
        }
        Data cells = Data::array();
        for (const study::Record *one : found)
          if (one == nullptr)
            cells.push_back({{"is_absent", true}});
          else
            cells.push_back(
                {{"is_absent", false},
                 {"look", one->cost.seconds() <= 1.1 * least ? "converges" : ""},
                 {"backend", one->text("operator")},
                 {"seconds", report::rounded_seconds(one->cost.seconds())},
                 {"megabytes", report::rounded(static_cast<double>(one->cost.peak_bytes) / 1e6)},
                 {"n_iterations", one->cost.n_iterations}});
        rows.push_back({{"method", row_run->key.method},
                        {"h", report::rounded(row_run->key.h)},
                        {"n_unknowns", row_run->cost.n_unknowns},
                        {"cells", std::move(cells)}});
      }
      return {{"scene", scene}, {"choices", std::move(heads)}, {"rows", std::move(rows)}};
    }

    Data solvers(const std::vector<Entry> &entries)
    {
      std::vector<std::string> scenes;
      for (const Entry &entry : entries)
        if (std::count(scenes.begin(), scenes.end(), entry.group) == 0)
          scenes.push_back(entry.group);
      Data list = Data::array();
      for (const std::string &scene : scenes)
        list.push_back(choices(entries, scene));
      return list;
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
              if (const study::Record *run = cheapest(question, target))
                table.rows.push_back({report::text_cell(entry.group + "/" + entry.name),
                                      report::text_cell(one.title()), report::number_cell(target),
                                      report::text_cell(run->key.method),
                                      report::number_cell(run->key.h),
                                      report::number_cell(relative_error(entry.results, *run)),
                                      report::number_cell(run->cost.seconds()),
                                      report::count_cell(run->cost.peak_bytes),
                                      report::count_cell(run->cost.n_bonds)});
            }
      return to_csv(table);
    }

    /// Of the header: solves, and where they were run.
    void add_facts(const std::vector<Entry> &entries, Data &data)
    {
      std::size_t n_runs = 0;
      std::map<std::string, std::string> machine;
      for (const Entry &entry : entries)
      {
        n_runs += entry.results.records.size();
        for (const char *key : {"processor", "version"})
          if (entry.results.provenance.count(key) > 0)
            machine.try_emplace(key, entry.results.provenance.at(key));
      }
      data["n_scenes"] = entries.size();
      data["n_runs"] = n_runs;
      data["machine"] = Data::array();
      for (const auto &[key, value] : machine)
        data["machine"].push_back(key + ": " + value);
    }
  } // namespace

  void write_page(const fs::path &atlas)
  {
    const std::vector<Entry> entries = read_entries(atlas, "scenes");
    if (entries.empty())
      throw InputError("'" + atlas.string() +
                       "' has no finished scenes; run benchmarks/atlas first");
    Data data = report::page::begin("atlas", "What a digit costs, and who fails",
                                    "Every shipped scene by every method that can do it. Which "
                                    "method is the cheapest for the accuracy you need?",
                                    {});
    add_facts(entries, data);
    data["targets"] = Data::array();
    for (const double target : targets)
      data["targets"].push_back(report::short_power(target));
    std::vector<Question> questions;
    data["scenes"] = Data::array();
    for (const Entry &entry : entries)
      if (has_errors(entry))
      {
        for (const report::Case &one : report::cases(entry.results))
          questions.push_back({&entry.results, one.problem, one.series});
        data["scenes"].push_back(details(entry));
      }
    data["n_cases"] = questions.size();
    data["groups"] = in_short(entries);
    data["tally"] = report::page::table(tally_table(questions));
    data["overview"] = overview(entries);
    data["solvers"] = solvers(read_entries(atlas, "solvers"));
    report::write_file(atlas / "index.html",
                       report::fill_text(benchmarks::templates().at("atlas"), data));
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
