#include "check_series.h"

#include "base/communicator.h"
#include "base/error.h"
#include "base/number_text.h"
#include "check_files.h"
#include "check_text.h"
#include "io/results_json.h"
#include "output_folder.h"
#include "report/report.h"
#include "report/text_table.h"
#include "run_parts.h"
#include "scene/values.h"
#include "study/conclusions.h"
#include "study/solution_record.h"
#include "study/trend.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace plumbline::app
{
  namespace fs = std::filesystem;
  using report::Table;

  namespace
  {
    bool has_mark(const std::string &file)
    {
      return file.find(scene::NodeSource::level_mark) != std::string::npos;
    }

    std::string at(const std::string &file, double h)
    {
      return scene::NodeSource{file}.file_at(h);
    }

    std::string level_name(double h)
    {
      return "h_" + scene::short_number(h);
    }

    /// Those of the scene's only series that both files are there for.
    std::vector<problem::Level> levels_with_files(const scene::Scene &scene,
                                                  const CheckOptions &options)
    {
      if (scene.study.series.size() > 1)
        throw InputError("files named " + options.nodes_file +
                         " stand for one series of levels, "
                         "but the scene has " +
                         std::to_string(scene.study.series.size()) +
                         "; give one value of Study/m, or of Study/horizon");
      std::vector<problem::Level> levels;
      std::string missing;
      for (const problem::Level &level : scene.study.series.front().levels)
      {
        const std::string nodes = at(options.nodes_file, level.h),
                          bonds = at(options.bonds_file, level.h);
        if (fs::exists(nodes) && fs::exists(bonds))
          levels.push_back(level);
        else
          missing += (missing.empty() ? "'" : ", '") + (fs::exists(nodes) ? bonds : nodes) + "'";
      }
      if (levels.size() < 2)
        throw InputError("a series needs the files of two levels of Study/h at least, but there "
                         "is no " +
                         missing);
      if (!missing.empty())
        std::cerr << "warning: levels without files are left out: there is no " << missing << '\n';
      return levels;
    }

    scene::Scene at_level_alone(scene::Scene scene, const problem::Level &level)
    {
      scene.study.series.front().levels = {level};
      return scene;
    }

    /// Of each level, with progress by the number of cells.
    std::vector<Findings> find_all(const scene::Scene &scene,
                                   const std::vector<problem::Level> &chosen,
                                   const std::vector<CheckOptions> &files)
    {
      double all = 0, done = 0;
      for (const problem::Level &level : chosen)
        all += std::pow(level.h, -2);
      ProgressLine progress(!files.front().quiet && base::Communicator::all().rank() == 0);
      std::vector<Findings> levels;
      for (std::size_t k = 0; k < chosen.size(); ++k)
      {
        progress.show("level " + std::to_string(k + 1) + " of " + std::to_string(chosen.size()),
                      done / all);
        levels.push_back(find(at_level_alone(scene, chosen[k]), files[k]));
        done += std::pow(chosen[k].h, -2);
      }
      return levels;
    }

    /// In norms that a check takes: others rest on what the weights do not give.
    scene::Scene with_known_error(scene::Scene scene)
    {
      auto &[norm, target] = scene.study.decisive_error;
      if (norm != scene::Norm::nodal_linf)
        norm = scene::Norm::averages_l2;
      if (target == scene::Target::finest || target == scene::Target::reference)
      {
        norm = scene::Norm::averages_l2; // the reference has no nodal values
        target = scene::Target::reference;
      }
      return scene;
    }

    study::StudyResults conclude(const scene::Scene &scene, const std::vector<Findings> &levels)
    {
      study::StudyResults results;
      results.analysis = "statics";
      results.scene_name = scene.name;
      results.purpose = scene.purpose;
      results.scene_text = scene.text;
      results.regime = scene.study.regime;
      results.decisive_error = scene.study.decisive_error.text();
      results.provenance = provenance();
      for (std::size_t k = 0; k < levels.size(); ++k)
        for (const CaseCheck &one : levels[k].cases)
          for (study::Record record : {one.weights, one.reference})
          {
            record.key.analysis = results.analysis;
            record.key.level = static_cast<unsigned int>(k);
            // the time of this program's solver, not of the code that made the weights
            record.cost.setup_seconds = record.cost.solve_seconds = 0;
            record.cost.peak_bytes = 0;
            results.records.push_back(std::move(record));
          }
      study::conclude(scene, results);
      results.advice.clear(); // on costs
      results.expectations.clear();
      return results;
    }

    /// Of the weights, by the error that decides.
    std::vector<study::Trend> trends_of(const study::StudyResults &results)
    {
      std::vector<study::Trend> trends;
      for (const study::Trend &trend : results.trends)
        if (trend.family == study::MethodFamily::meshfree && trend.error == results.decisive_error)
          trends.push_back(trend);
      return trends;
    }

    Table table_of(const std::vector<Findings> &levels, const std::vector<study::Trend> &trends)
    {
      Table table;
      table.columns = {"h",      "horizon", "bonds", "first moments", "second moments",
                       "median", "rule"};
      for (const study::Trend &trend : trends)
        for (const char *const what : {"error of ", "rate of "})
          table.columns.emplace_back(what + trend.problem);
      for (std::size_t k = 0; k < levels.size(); ++k)
      {
        const Findings &found = levels[k];
        table.rows.push_back({report::number_cell(found.level.level.h),
                              report::number_cell(found.level.level.horizon),
                              report::count_cell(found.weights.n_bonds),
                              report::error_cell(found.moments.defects[0].worst.value),
                              report::error_cell(found.moments.second.value),
                              report::error_cell(found.moments.defects[1].median),
                              report::text_cell(found.rule)});
        for (const study::Trend &trend : trends)
        {
          const auto place =
              std::find(trend.x.begin(), trend.x.end(), found.level.level.h) - trend.x.begin();
          const auto i = static_cast<std::size_t>(place);
          const bool is_there = i < trend.x.size();
          table.rows.back().push_back(
              report::known(is_there, report::error_cell(is_there ? trend.values[i] : 0)));
          table.rows.back().push_back(report::number_cell(study::observed_rate(trend, i)));
        }
      }
      return table;
    }

    /// Of all levels, and of the errors.
    std::vector<std::string> complaints_of(const std::vector<Findings> &levels,
                                           const std::vector<study::Trend> &trends,
                                           const Requirements &required)
    {
      std::vector<std::string> wrong;
      for (const Findings &found : levels)
        for (const std::string &one : complaints(found, required))
          wrong.push_back("h = " + base::to_text(found.level.level.h, 6) + ": " + one);
      for (const study::Trend &trend : trends)
        if (required.ac &&
            (trend.outcome == study::Outcome::stalls || trend.outcome == study::Outcome::failed))
          wrong.push_back("required ac: " + trend.problem + ", " + trend.error + ": " +
                          trend.verdict);
      return wrong;
    }

    std::string text_of(const study::StudyResults &results, const Table &table,
                        const std::vector<study::Trend> &trends,
                        const std::vector<std::string> &wrong, const std::string &more)
    {
      constexpr std::size_t most_complaints = 6;
      std::vector<std::string> sentences;
      for (std::size_t i = 0; i < std::min(most_complaints, wrong.size()); ++i)
        sentences.push_back(wrong[i]);
      if (wrong.size() > most_complaints)
        sentences.push_back("and " + std::to_string(wrong.size() - most_complaints) +
                            " more in check.json");
      for (const study::Trend &trend : trends)
        sentences.push_back(trend.problem + ", " + trend.error + ": " + trend.verdict + "; " +
                            trend.reason);
      return check_summary(
          report::heading(results.scene_name, results.purpose) + "\n\n" +
              report::to_text(report::without_empty_columns(table), report::summary_columns) + more,
          sentences, wrong.empty() ? "as required" : "NOT as required");
    }
  } // namespace

  bool is_series(const CheckOptions &options)
  {
    if (has_mark(options.nodes_file) != has_mark(options.bonds_file))
      throw InputError("of '" + options.nodes_file + "' and '" + options.bonds_file +
                       "' one is a series and one is not; write {h} in both names, or in none");
    return has_mark(options.nodes_file);
  }

  int check_series(const scene::Scene &given, const CheckOptions &options,
                   const Requirements &required)
  {
    scene::Scene scene = with_known_error(given);
    const std::vector<problem::Level> chosen = levels_with_files(scene, options);
    scene.study.series.front().levels = chosen;
    std::vector<CheckOptions> files(chosen.size(), options);
    for (std::size_t k = 0; k < chosen.size(); ++k)
    {
      files[k].nodes_file = at(options.nodes_file, chosen[k].h);
      files[k].bonds_file = at(options.bonds_file, chosen[k].h);
    }
    const std::vector<Findings> levels = find_all(scene, chosen, files);
    const study::StudyResults results = conclude(scene, levels);
    const std::vector<study::Trend> trends = trends_of(results);
    const std::vector<std::string> wrong = complaints_of(levels, trends, required);
    const int exit_code = wrong.empty() ? 0 : 1;
    if (base::Communicator::all().rank() != 0)
      return exit_code;
    nlohmann::ordered_json json = {{"schema", check_schema},
                                   {"levels", nlohmann::ordered_json::array()}};
    for (std::size_t k = 0; k < levels.size(); ++k)
      json["levels"].push_back(nlohmann::ordered_json::parse(check_json(
          levels[k], required, files[k], complaints(levels[k], required).empty() ? 0 : 1)));
    json["study"] = nlohmann::ordered_json::parse(io::to_json(results));
    json["complaints"] = wrong;
    json["exit_code"] = exit_code;
    const std::string all = json.dump(2) + "\n";
    const fs::path folder = options.output.empty() ? fs::path("results") / ("check_" + scene.name)
                                                   : fs::path(options.output);
    const std::string assumed = assumed_horizon(scene, options, chosen.front());
    if (options.json)
      std::cout << all;
    else if (!options.quiet)
      std::cout << text_of(results, table_of(levels, trends), trends, wrong,
                           (assumed.empty() ? "" : assumed + "\n") +
                               "report: " + (folder / "report.html").string() + "\n");
    const bool is_silent = options.quiet || options.json;
    if (is_silent && options.output.empty())
      return exit_code;
    const OutputFolder output(folder, {"check", scene.name, scene.text},
                              base::Communicator::alone());
    report::write_file(folder / "check.json", all);
    report::write_file(folder / "levels.csv", report::to_csv(table_of(levels, trends)));
    for (std::size_t k = 0; k < levels.size(); ++k)
    {
      const fs::path own = folder / level_name(chosen[k].h);
      fs::create_directories(own);
      write_check(levels[k], required, files[k], complaints(levels[k], required).empty() ? 0 : 1,
                  own);
    }
    report::write_report(results, folder);
    return exit_code;
  }
} // namespace plumbline::app
