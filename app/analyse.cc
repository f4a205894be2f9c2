#include "analyse.h"

#include "base/communicator.h"
#include "base/error.h"
#include "io/point_vtu.h"
#include "io/record_journal.h"
#include "io/results_json.h"
#include "methods.h"
#include "output_folder.h"
#include "report/formats.h"
#include "report/frames.h"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <optional>

namespace plumbline::app
{
  namespace fs = std::filesystem;

  namespace
  {
    /// All that records depend on.
    std::string subject_of(const study::Analysis &analysis, const AnalyseOptions &options,
                           const scene::Scene &scene)
    {
      return "# levels: " + std::to_string(options.n_levels) + ", " + analysis.name + ": " +
             analysis.options + "\n" + scene.text;
    }

    /// The fields of a series' finest level, each to a file.
    void write_fields(const study::Records &records, const scene::Scene &scene,
                      unsigned int n_levels, const fs::path &folder)
    {
      for (const study::Record &record : records)
      {
        const auto &all = scene.study.series;
        const auto series =
            std::find_if(all.begin(), all.end(),
                         [&](const problem::Series &one) { return one.name == record.key.series; });
        const std::size_t n = series->levels.size(),
                          last = n_levels == 0 ? n : std::min<std::size_t>(n_levels, n);
        unsigned int k = 0;
        for (const auto &[name, field] : record.fields)
          if (record.key.level + 1 == last)
            io::write_vtu(field, folder / (report::slug(record.key.label()) + "_" +
                                           report::slug(record.key.series) +
                                           (++k > 1 ? "_" + std::to_string(k) : "") + ".vtu"));
      }
    }

    /// So that no work is lost at the end.
    void require_writable(const fs::path &file)
    {
      const bool is_there = fs::exists(file);
      if (!std::ofstream(file, std::ios::app))
        report::write_file(file, ""); // tells why not
      if (!is_there)
        fs::remove(file);
    }

    /// States of a strip for ParaView.
    study::WriteStrip frame_writer(const fs::path &folder)
    {
      return [folder](const std::vector<double> &times, const std::vector<dealii::Point<2>> &nodes,
                      const study::Vector &u_of_nodes, const study::Vector &damage_of_nodes)
      {
        const auto u = [&](std::size_t node, unsigned int component)
        { return u_of_nodes[component * nodes.size() + node]; };
        const auto damage = [&](std::size_t node, unsigned int) { return damage_of_nodes[node]; };
        report::write_frame(folder, "frame", times, nodes,
                            {{"u", true, u}, {"damage", false, damage}});
      };
    }
  } // namespace

  AnalysisRow stability_row()
  {
    return {study::stability_analysis(), report::stability_view};
  }

  AnalysisRow strip_row()
  {
    return {study::strip_analysis(), report::strip_view};
  }

  AnalysisRow dispersion_row(const study::AskedDirections &directions)
  {
    return {study::dispersion_analysis(directions), report::dispersion_view};
  }

  AnalysisRow crack_row(const study::Checkpoints &checkpoints)
  {
    return {study::crack_analysis(checkpoints, frame_writer(checkpoints.folder / "frames")),
            report::crack_view};
  }

  AnalysisRow growth_row(const study::Checkpoints &checkpoints)
  {
    const auto write =
        [folder = checkpoints.folder / "frames"](const std::vector<double> &loads,
                                                 const std::vector<dealii::Point<3>> &nodes,
                                                 const std::vector<double> &damage)
    {
      report::write_frame(
          folder, "damage", loads, nodes,
          {{"damage", false, [&](std::size_t node, unsigned int) { return damage[node]; }}});
    };
    return {study::growth_analysis(checkpoints, write), report::growth_view};
  }

  namespace
  {
    int exit_code(const AnalysisRow &row, const AnalyseOptions &options,
                  const study::StudyResults &results)
    {
      bool has_failed = false, all_hold = true;
      for (const study::Record &record : results.records)
        if (!row.analysis.are_failures_findings && !record.failure.empty())
        {
          has_failed = true;
          const study::Key &key = record.key;
          std::cerr << "no result: " << key.label() << ", " << key.series << ", h = " << key.h
                    << ": " << record.failure << '\n';
        }
      for (const study::Expectation &one : results.expectations)
        if (options.check && !one.holds)
        {
          all_hold = false;
          std::cerr << "not as expected: " << one.subject << ": found " << one.found << '\n';
        }
      return has_failed ? 3 : all_hold ? 0 : 1;
    }
  } // namespace

  int analyse(const MakeRow &make_row, const AnalyseOptions &options)
  {
    end_at_interrupts();
    return analyse(make_row, options, read_alone(options));
  }

  int analyse(const MakeRow &make_row, const AnalyseOptions &options, const scene::Scene &scene)
  {
    if (!(options.budget >= 0))
      throw InputError(
          "--budget is negative; give CPU seconds of one method at one level, or leave "
          "it out");
    std::optional<ProgressLine> progress(!options.quiet);
    const fs::path folder = output_folder(options, scene);
    const study::Checkpoints checkpoints{folder, is_interrupted};
    const AnalysisRow row = make_row(checkpoints);
    const study::Analysis &analysis = row.analysis;
    const method::Methods methods =
        analysis.choose_methods(scene, all_methods(), options.n_levels, 1);
    if (analysis.check)
      analysis.check(scene, methods, options.n_levels);
    progress.reset();
    watch_interrupts();
    const OutputFolder output(folder, {row.command, scene.name, scene.text},
                              base::Communicator::alone());
    require_writable(folder / (analysis.name + ".md"));
    io::RecordJournal journal(folder / (analysis.name + ".jsonl"),
                              subject_of(analysis, options, scene));
    if (!journal.earlier().empty() && !options.quiet)
      std::cerr << "continuing: " << journal.earlier().size() << " records are in '"
                << (folder / (analysis.name + ".jsonl")).string() << "' already\n";

    study::RunControl control;
    control.n_levels = options.n_levels;
    control.budget = options.budget;
    control.should_stop = is_interrupted;
    control.earlier.records = journal.earlier();
    progress.emplace(!options.quiet);
    control.on_progress = [&](const std::string &what, double fraction)
    { progress->show(what, fraction); };
    control.on_records = [&](const study::Records &records)
    {
      journal.append(records);
      std::error_code code;
      fs::remove(checkpoints.file(), code);
      write_fields(records, scene, options.n_levels, folder / analysis.name);
    };
    write_fields(journal.earlier(), scene, options.n_levels, folder / analysis.name);
    study::StudyResults results = run_study(analysis, scene, methods, control);
    progress.reset();
    results.provenance = provenance();
    for (const std::string &warning : results.warnings)
      std::cerr << "warning: " << warning << '\n';

    const report::View view = row.view(results);
    report::write_study(view, results, folder);
    if (!results.is_complete)
      return say_interrupted(folder);
    journal.remove();
    if (options.json)
      std::cout << io::to_json(results);
    else if (!options.quiet)
      std::cout << report::study_summary(view, results,
                                         (folder / (analysis.name + ".html")).string());
    return exit_code(row, options, results);
  }
} // namespace plumbline::app
