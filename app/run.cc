#include "run.h"

#include "base/communicator.h"
#include "base/error.h"
#include "dynamics.h"
#include "estimate.h"
#include "io/point_values.h"
#include "io/record_journal.h"
#include "methods.h"
#include "output_folder.h"
#include "report/report.h"
#include "report/statics_summary.h"
#include "scene/capabilities.h"
#include "study/preflight.h"
#include "study/sampling.h"
#include "study/statics.h"
#include "work_of_ranks.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>

namespace plumbline::app
{
  namespace fs = std::filesystem;

  namespace
  {
    scene::Scene read(const RunOptions &options)
    {
      auto overrides = options.overrides;
      if (!options.model.empty())
        overrides.push_back({"Solver/model", options.model});
      scene::Scene scene = scene_of_file(options.scene_file, overrides, options.methods);
      if (scene.fracture.is_there())
        throw InputError("scene '" + scene.name +
                         "': Fracture/toughness is for 'plumbline grow', which breaks bonds; write "
                         "that, or clear it");
      return scene;
    }

    /// @param points  outlive it
    study::StaticsOptions statics_options(const scene::Scene &scene, const fs::path &folder,
                                          const base::Communicator &communicator,
                                          io::PointValues &points)
    {
      study::StaticsOptions options;
      options.ranks = communicator;
      if (points.is_wanted())
      {
        options.points = [&points](const problem::Problem<2> &problem)
        { return points.of(problem); };
        options.points_in_space = [&points](const problem::Problem<3> &problem)
        { return points.of(problem); };
        options.on_values = [communicator, folder, &points](const study::ValuesAtPoints &found,
                                                            const study::Record &run)
        { on_first_rank(communicator, [&] { points.write(found, run, folder / "points"); }); };
      }
      if (scene.output.fields)
        options.on_finest =
            [communicator, folder](const std::function<void(const std::string &)> &write_field,
                                   const study::Record &run)
        {
          on_first_rank(communicator,
                        [&]
                        {
                          fs::create_directories(folder / "fields");
                          write_field((folder / "fields" / io::file_stem(run)).string());
                        });
        };
      return options;
    }

    /// @param points  outlive it
    AnalysisRow statics_row(const scene::Scene &scene, const fs::path &folder,
                            io::PointValues &points)
    {
      // every rank runs the scene, and they share the work on meshes
      const base::Communicator communicator = base::Communicator::all();
      AnalysisRow row{study::statics_analysis(
          all_methods(), statics_options(scene, folder, communicator, points))};
      row.command = "run";
      row.file = "results";
      row.write = report::write_report;
      row.summary = report::statics_summary;
      row.ranks = communicator;
      // comparisons with the method's own finest level need all solutions
      row.goes_on = scene.study.decisive_error.target != scene::Target::finest;
      if (const auto spectrum = study::field_spectrum(scene.random))
        row.provenance["random field"] = words_of(*spectrum);
      if (communicator.n_ranks() > 1)
      {
        const method::Methods methods = study::choose_methods(scene, all_methods());
        const std::string work = work_of_ranks(scene, methods);
        if (!work.empty())
          row.provenance["work of ranks"] = work;
        if (work.find("repeated") == 0)
          row.note = repetition(scene, methods, communicator.n_ranks());
      }
      return row;
    }
  } // namespace

  int run(const RunOptions &options)
  {
    end_at_interrupts();
    const scene::Scene scene = read(options);
    if (options.is_estimate && options.json)
      throw InputError(
          "--estimate prints a text table and cannot be combined with --json, which prints "
          "the results of a run; leave out one of them");
    if (options.is_estimate)
      return print_estimate(options, scene);
    if (scene.time.is_dynamic())
    {
      check_analysis(scene, scene::Analysis::transient);
      return run_transient(options, scene);
    }
    io::PointValues points(scene);
    return analyse([&](const study::Checkpoints &checkpoints)
                   { return statics_row(scene, checkpoints.folder, points); },
                   options, scene);
  }

  int rebuild_report(const std::string &folder)
  {
    const study::StudyResults results = io::results_in(folder);
    const OutputFolder output(folder, {"run", results.scene_name, results.scene_text},
                              base::Communicator::alone());
    report::write_report(results, folder);
    std::cout << "report: " << (fs::path(folder) / "report.html").string() << '\n';
    return 0;
  }
} // namespace plumbline::app
