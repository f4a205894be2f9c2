#include "check/series.h"

#include "base/content_hash.h"
#include "base/cost.h"
#include "base/error.h"
#include "base/number_text.h"
#include "check/files.h"
#include "check/text.h"
#include "io/results_json.h"
#include "report/text_table.h"
#include "report/view.h"
#include "scene/values.h"
#include "study/conclusions.h"
#include "study/solution_record.h"
#include "study/trend.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace plumbline::check
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

    scene::Scene at_level_alone(scene::Scene scene, const problem::Level &level)
    {
      scene.study.series.front().levels = {level};
      return scene;
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

    /// Stands in the loop over levels for the weights of the files, which find() solves by.
    class GivenWeights : public method::Method
    {
    public:
      std::string name() const override { return "given weights"; }
      method::MethodFamily family() const override { return method::MethodFamily::meshfree; }
      std::string help() const override { return "weights of files"; }
      std::unique_ptr<method::Discretisation> discretise(const problem::Problem<2> &,
                                                         const base::Communicator &) const override
      {
        throw NumericalError("weights of files are those of a level");
      }
    };

    study::Records records_of(const Findings<2> &found)
    {
      study::Records records;
      for (const CaseCheck &one : found.cases)
        for (study::Record record : {one.weights, one.reference})
        {
          record.key.analysis = "statics";
          records.push_back(std::move(record));
        }
      return records;
    }

    /// Of all that is done at a level: it decides whether the next one can be afforded. Records
    /// that an interrupted check has left keep what it took.
    /// @param made  that of the weights first
    void set_cost(double seconds, study::Records &made)
    {
      for (const study::Record &record : made)
        seconds = std::max(seconds, record.cost.seconds());
      for (study::Record &record : made)
        record.cost.setup_seconds = record.cost.solve_seconds = 0;
      if (!made.empty())
        made.front().cost.solve_seconds = seconds;
    }

    void conclude(const scene::Scene &scene, study::StudyResults &results)
    {
      for (study::Record &record : results.records)
      {
        // the time of this program's solver, not of the code that made the weights
        record.cost.setup_seconds = record.cost.solve_seconds = 0;
        record.cost.peak_bytes = 0;
      }
      if (scene.domain.is_in_space())
        return;
      results.analysis = "statics";
      study::conclude(scene, results);
      results.advice.clear(); // on costs
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

    /// Of degree 2 in the plane, of degrees 1 and 2 in space, as in former versions.
    template <int dim>
    double median_moment(const meshfree::MomentCheck &moments)
    {
      return dim == 2 ? moments.defects[1].median : moments.typical();
    }

    template <int dim>
    std::vector<report::Cell> row_of(const Findings<dim> &found)
    {
      return {report::number_cell(found.level.level.h),
              report::number_cell(found.level.level.horizon),
              report::count_cell(found.weights.n_bonds),
              report::error_cell(found.moments.defects[0].worst.value),
              report::error_cell(found.moments.second.value),
              report::error_cell(median_moment<dim>(found.moments)),
              report::text_cell(found.rule)};
    }

    Table table_of(const Series &all)
    {
      const std::vector<study::Trend> &trends = all.trends;
      Table table;
      table.columns = {"h",      "horizon", "bonds", "first moments", "second moments",
                       "median", "rule"};
      for (const study::Trend &trend : trends)
        for (const char *const what : {"error of ", "rate of "})
          table.columns.emplace_back(what + trend.problem);
      for (const Findings<3> &found : all.levels_in_space)
        table.rows.push_back(row_of(found));
      for (const Findings<2> &found : all.levels)
      {
        table.rows.push_back(row_of(found));
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

    nlohmann::ordered_json parsed(const std::string &json)
    {
      return nlohmann::ordered_json::parse(json);
    }

    template <int dim>
    int exit_code(const Findings<dim> &found, const Requirements &required)
    {
      return complaints(found, required).empty() ? 0 : 1;
    }
  } // namespace

  bool is_series(const Input &input)
  {
    if (has_mark(input.nodes_file) != has_mark(input.bonds_file))
      throw InputError("of '" + input.nodes_file + "' and '" + input.bonds_file +
                       "' one is a series and one is not; write {h} in both names, or in none");
    return has_mark(input.nodes_file);
  }

  LevelFiles find_level_files(const scene::Scene &scene, const Input &input)
  {
    if (scene.study.series.size() > 1)
      throw InputError("files named " + input.nodes_file +
                       " stand for one series of levels, "
                       "but the scene has " +
                       std::to_string(scene.study.series.size()) +
                       "; give one value of Study/m, or of Study/horizon");
    LevelFiles files{with_known_error(scene), {}, {}, ""};
    for (const problem::Level &level : scene.study.series.front().levels)
    {
      Input own = input;
      own.nodes_file = at(input.nodes_file, level.h);
      own.bonds_file = at(input.bonds_file, level.h);
      const bool has_nodes = fs::exists(own.nodes_file);
      if (has_nodes && fs::exists(own.bonds_file))
      {
        files.levels.push_back(level);
        files.inputs.push_back(own);
      }
      else
        files.missing += (files.missing.empty() ? "'" : ", '") +
                         (has_nodes ? own.bonds_file : own.nodes_file) + "'";
    }
    if (files.levels.size() < 2)
      throw InputError("a series needs the files of two levels of Study/h at least, but there "
                       "is no " +
                       files.missing);
    files.scene.study.series.front().levels = files.levels;
    return files;
  }

  std::string subject_of(const LevelFiles &files)
  {
    std::string text = "check";
    for (const Input &input : files.inputs)
    {
      text += "\n" + input.bonds_are;
      for (const std::string &name : {input.nodes_file, input.bonds_file})
      {
        if (!fs::is_regular_file(name))
          return ""; // a pipe, which is read once
        std::stringstream content;
        content << std::ifstream(name, std::ios::binary).rdbuf();
        text += ", " + name + ": " + base::content_hash(content.str());
      }
    }
    return text + "\n" + files.scene.text;
  }

  Series find_series(const LevelFiles &files, const method::Methods &references,
                     const study::RunControl &control)
  {
    Series found;
    study::Records made; // of the present level
    study::Analysis analysis{"check", "Weights of files"};
    analysis.has_decisive_error = !files.scene.domain.is_in_space();
    analysis.begin = [&](const study::Place &place) // its errors end the study
    {
      const base::CpuTimer timer;
      const scene::Scene scene = at_level_alone(files.scene, place.level());
      const Input &input = files.inputs[place.number()];
      if (scene.domain.is_in_space())
        made = {record_of(found.levels_in_space.emplace_back(find_in_space(scene, input)))};
      else
        made = records_of(
            found.levels.emplace_back(find(scene, input, references, control.earlier.records)));
      set_cost(timer.seconds(), made);
      for (study::Record &record : made)
      {
        record.key.series = place.series().name;
        record.key.level = place.number();
      }
    };
    analysis.has_parts = true; // findings are made again, without solving what is known
    analysis.analyse = [&](const study::Place &, const method::Method &) { return made; };
    analysis.conclude = conclude;
    found.results =
        run_study(analysis, files.scene, {std::make_shared<const GivenWeights>()}, control);
    found.results.expectations.clear();
    found.trends = trends_of(found.results);
    found.assumed = assumptions(files.scene, files.inputs.front(), files.levels.front());
    return found;
  }

  std::vector<std::string> complaints(const Series &found, const Requirements &required)
  {
    std::vector<std::string> wrong;
    const auto add = [&](const auto &level)
    {
      for (const std::string &one : complaints(level, required))
        wrong.push_back("h = " + base::to_text(level.level.level.h, 6) + ": " + one);
    };
    for (const Findings<2> &level : found.levels)
      add(level);
    for (const Findings<3> &level : found.levels_in_space)
      add(level);
    for (const study::Trend &trend : found.trends)
      if (required.ac &&
          (trend.outcome == study::Outcome::stalls || trend.outcome == study::Outcome::failed))
        wrong.push_back("required ac: " + trend.problem + ", " + trend.error + ": " +
                        trend.verdict);
    return wrong;
  }

  std::string text(const Series &found, const Requirements &required, const std::string &page)
  {
    constexpr std::size_t most_complaints = 6;
    const std::vector<std::string> wrong = complaints(found, required);
    std::vector<std::string> sentences;
    for (std::size_t i = 0; i < std::min(most_complaints, wrong.size()); ++i)
      sentences.push_back(wrong[i]);
    if (wrong.size() > most_complaints)
      sentences.push_back("and " + std::to_string(wrong.size() - most_complaints) +
                          " more in check.json");
    for (const study::Trend &trend : found.trends)
      sentences.push_back(trend.problem + ", " + trend.error + ": " + trend.verdict + "; " +
                          trend.reason);
    const Table table = report::without_empty_columns(table_of(found));
    return check_summary(
        report::heading(found.results.scene_name, found.results.purpose) + "\n\n" +
            report::to_text(table, report::summary_columns) +
            (found.assumed.empty() ? "" : found.assumed + "\n") +
            (found.levels_in_space.empty() ? "report: " + page + "\n" : not_checked_in_space),
        sentences, wrong.empty() ? "as required" : "NOT as required");
  }

  std::string to_json(const Series &found, const LevelFiles &files, const Requirements &required)
  {
    const std::vector<std::string> wrong = complaints(found, required);
    nlohmann::ordered_json json = {{"schema", check_schema},
                                   {"levels", nlohmann::ordered_json::array()}};
    const auto add = [&](const auto &levels)
    {
      for (std::size_t k = 0; k < levels.size(); ++k)
        json["levels"].push_back(parsed(
            check_json(levels[k], required, files.inputs[k], exit_code(levels[k], required))));
    };
    add(found.levels);
    add(found.levels_in_space);
    json["study"] = parsed(io::to_json(found.results));
    json["complaints"] = wrong;
    json["exit_code"] = wrong.empty() ? 0 : 1;
    return json.dump(2) + "\n";
  }

  void write_series(const Series &found, const LevelFiles &files, const Requirements &required,
                    const fs::path &folder)
  {
    report::write_file(folder / "check.json", to_json(found, files, required));
    report::write_file(folder / "levels.csv", report::to_csv(table_of(found)));
    const auto write_levels = [&](const auto &levels)
    {
      for (std::size_t k = 0; k < levels.size(); ++k)
      {
        const fs::path own = folder / level_name(files.levels[k].h);
        fs::create_directories(own);
        write_check(levels[k], required, files.inputs[k], exit_code(levels[k], required), own);
      }
    };
    write_levels(found.levels);
    write_levels(found.levels_in_space);
    if (files.scene.domain.is_in_space())
      return;
    report::write_study(report::statics_view(found.results), found.results, folder);
  }
} // namespace plumbline::check
