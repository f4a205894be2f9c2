#include "analyse.h"

#include "base/communicator.h"
#include "base/error.h"
#include "io/point_vtu.h"
#include "io/record_journal.h"
#include "io/results_json.h"
#include "methods.h"
#include "output_folder.h"
#include "report/formats.h"

#include <iostream>

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
  } // namespace

  AnalysisRow stability_row()
  {
    return {study::stability_analysis(), report::stability_view};
  }

  AnalysisRow strip_row()
  {
    return {study::strip_analysis(), report::strip_view};
  }

  AnalysisRow dispersion_row(const std::vector<double> &angles)
  {
    return {study::dispersion_analysis(angles), report::dispersion_view};
  }

  int analyse(const AnalysisRow &row, const AnalyseOptions &options)
  {
    if (!(options.budget >= 0))
      throw InputError(
          "--budget is negative; give CPU seconds of one method at one level, or leave "
          "it out");
    const study::Analysis &analysis = row.analysis;
    const scene::Scene scene = read_alone(options);
    const method::Methods methods =
        analysis.choose_methods(scene, all_methods(), options.n_levels, 1);
    const fs::path folder = output_folder(options, scene);
    const OutputFolder output(folder, {analysis.name, scene.name, scene.text},
                              base::Communicator::alone());
    watch_interrupts();
    report::write_file(folder / (analysis.name + ".md"), ""); // can it be written?
    io::RecordJournal journal(folder / (analysis.name + ".jsonl"),
                              subject_of(analysis, options, scene));
    if (!journal.earlier().empty() && !options.quiet)
      std::cerr << "continuing: " << journal.earlier().size() << " records are in '"
                << (folder / (analysis.name + ".jsonl")).string() << "' already\n";

    study::RunControl control;
    control.n_levels = options.n_levels;
    control.budget = options.budget;
    control.should_stop = is_interrupted;
    control.earlier = journal.earlier();
    ProgressLine progress(!options.quiet);
    control.on_progress = [&](const std::string &what, double fraction)
    { progress.show(what, fraction); };
    control.on_records = [&](const study::Records &records)
    {
      journal.append(records);
      write_fields(records, scene, options.n_levels, folder / analysis.name);
    };
    write_fields(journal.earlier(), scene, options.n_levels, folder / analysis.name);
    const study::StudyResults results = run_study(analysis, scene, methods, control);

    const report::View view = row.view(results);
    report::write_study(view, results, folder);
    if (!results.is_complete)
      return say_interrupted(folder);
    journal.remove();
    if (options.json)
      std::cout << io::to_json(results);
    else if (!options.quiet)
      std::cout << report::study_text(view, results)
                << "\nwritten: " << (folder / (analysis.name + ".html")).string() << '\n';
    bool all_hold = true;
    for (const study::Expectation &one : results.expectations)
      if (options.check && !one.holds)
      {
        all_hold = false;
        std::cerr << "not as expected: " << one.subject << ": found " << one.found << '\n';
      }
    return all_hold ? 0 : 1;
  }
} // namespace plumbline::app
