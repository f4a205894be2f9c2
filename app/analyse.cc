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
    AnalysisRow row{study::crack_analysis(checkpoints, frame_writer(checkpoints.folder / "frames")),
                    report::crack_view};
    row.has_checkpoint = true;
    return row;
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
    AnalysisRow row{study::growth_analysis(checkpoints, write), report::growth_view};
    row.has_checkpoint = true;
    return row;
  }

  namespace
  {
    /// A failure that the scene expects ("method: failed") is no error of the command.
    bool is_expected_failure(const study::StudyResults &results, const study::Record &record)
    {
      const study::Key &key = record.key;
      const std::string subject = key.method + ", " + key.problem + ", " + key.series + ": verdict";
      return std::any_of(results.expectations.begin(), results.expectations.end(),
                         [&](const study::Expectation &e) {
                           return e.subject == subject &&
                                  e.expected == base::word(study::Outcome::failed) && e.holds;
                         });
    }

    /// What went wrong, on standard error.
    void tell_failures(const study::StudyResults &results)
    {
      for (const study::Record &record : results.records)
        if (const study::Key &key = record.key; !record.failure.empty())
          std::cerr << "no result: " << key.label()
                    << (key.problem.empty() ? "" : ", " + key.problem) << ", " << key.series
                    << ", h = " << key.h << ": " << record.failure << '\n';
    }

    int exit_code(const AnalysisRow &row, bool check, const study::StudyResults &results)
    {
      if (!results.is_complete)
        return 130;
      for (const study::Record &record : results.records)
        if (!row.analysis.are_failures_findings && !record.failure.empty() &&
            !is_expected_failure(results, record))
          return 3;
      const bool holds = std::all_of(results.expectations.begin(), results.expectations.end(),
                                     [](const study::Expectation &e) { return e.holds; });
      return check && !holds ? 1 : 0;
    }

    /// What an interrupted command has left. All ranks have read it before the first one writes,
    /// and go on from the same.
    study::StudyResults earlier_results(const AnalysisRow &row, io::RecordJournal &journal)
    {
      const auto n_found = static_cast<double>(journal.earlier().records.size());
      if (!row.goes_on || row.ranks.largest(n_found) != -row.ranks.largest(-n_found))
        journal.forget();
      study::StudyResults earlier = journal.earlier();
      earlier.provenance = provenance();
      earlier.provenance.insert(row.provenance.begin(), row.provenance.end());
      return earlier;
    }

    void tell_warnings(const study::StudyResults &results)
    {
      for (const std::string &warning : results.warnings)
        std::cerr << "warning: " << warning << '\n';
    }

    void write_pages(const AnalysisRow &row, const study::StudyResults &results,
                     const fs::path &folder)
    {
      if (row.write)
        return row.write(results, folder);
      tell_warnings(results);
      report::write_study(row.view(results), results, folder);
    }

    /// What is wanted on standard output; what went wrong on standard error.
    void tell_end(const AnalysisRow &row, const AnalyseOptions &options,
                  const study::StudyResults &results, const fs::path &folder)
    {
      if (options.json)
        std::cout << io::to_json(results);
      else if (!options.quiet && row.summary)
      {
        std::cout << row.summary(results, folder);
        tell_warnings(results);
      }
      else if (!options.quiet)
        std::cout << report::study_summary(row.view(results), results,
                                           (folder / (row.analysis.name + ".html")).string());
      if (!results.is_complete)
        say_interrupted(folder, row.goes_on);
      if (!row.analysis.are_failures_findings)
        tell_failures(results);
      for (const study::Expectation &one : results.expectations)
        if (results.is_complete && options.check && !one.holds)
          std::cerr << "not as expected: " << one.subject << ": found " << one.found << '\n';
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
    const bool is_talking = !options.quiet && base::Communicator::all().rank() == 0;
    std::optional<base::ProgressLine> progress(is_talking);
    const fs::path folder = output_folder(options.output, scene);
    const study::Checkpoints checkpoints{folder, is_interrupted};
    const AnalysisRow row = make_row(checkpoints);
    const study::Analysis &analysis = row.analysis;
    const method::Methods methods =
        analysis.choose_methods(scene, all_methods(), options.n_levels, 1);
    if (analysis.check)
      analysis.check(scene, methods, options.n_levels);
    progress.reset();
    watch_interrupts();
    const OutputFolder output(folder, {row.command, scene.name, scene.text}, row.ranks);
    const fs::path journal_file = folder / (row.file + ".jsonl");
    on_first_rank(row.ranks, [&] { require_writable(folder / (row.file + ".json")); });
    io::RecordJournal journal(journal_file, subject_of(analysis, options, scene));

    study::RunControl control;
    control.n_levels = options.n_levels;
    control.budget = options.budget;
    control.ranks = row.ranks;
    control.should_stop = [&] { return row.ranks.any(is_interrupted()); };
    control.earlier = earlier_results(row, journal);
    if (!row.note.empty() && row.ranks.rank() == 0)
      std::cerr << "note: " << row.note << '\n';
    if (!control.earlier.records.empty() && is_talking)
      std::cerr << "continuing: " << control.earlier.records.size() << " records are in '"
                << journal_file.string() << "' already\n";
    const auto write_all_fields = [&](const study::Records &records)
    { write_fields(records, scene, options.n_levels, folder / analysis.name); };
    control.on_made = [&](const study::StudyResults &made)
    {
      on_first_rank(row.ranks,
                    [&]
                    {
                      journal.append(made);
                      std::error_code code;
                      if (row.has_checkpoint && !made.records.empty())
                        fs::remove(checkpoints.file(), code);
                      write_all_fields(made.records);
                    });
    };
    progress.emplace(is_talking);
    control.on_progress = [&](const std::string &what, double fraction)
    { progress->show(what, fraction); };
    on_first_rank(row.ranks, [&] { write_all_fields(control.earlier.records); });
    const study::StudyResults results = run_study(analysis, scene, methods, control);
    progress.reset();
    on_first_rank(row.ranks,
                  [&]
                  {
                    write_pages(row, results, folder);
                    if (results.is_complete)
                      journal.remove();
                  });
    if (row.ranks.rank() == 0)
      tell_end(row, options, results, folder);
    return exit_code(row, options.check, results);
  }
} // namespace plumbline::app
