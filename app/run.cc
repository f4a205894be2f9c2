#include "run.h"

#include "base/choice.h"
#include "base/communicator.h"
#include "base/error.h"
#include "dynamics.h"
#include "io/record_journal.h"
#include "methods.h"
#include "output_folder.h"
#include "point_values.h"
#include "report/report.h"
#include "run_parts.h"
#include "scene/capabilities.h"
#include "study/conclusions.h"
#include "study/method_names.h"
#include "study/preflight.h"
#include "study/sampling.h"
#include "study/statics.h"
#include "summary.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <optional>

namespace plumbline::app
{
  namespace fs = std::filesystem;

  namespace
  {
    /// Whether ranks do the same side by side: on lattices and in space, and rules on free bodies.
    bool repeats_work(const scene::Scene &scene, const method::Methods &methods)
    {
      if (!scene.domain.is_free_body)
        return scene.domain.mesh.is_lattice() || scene.domain.is_in_space();
      return std::any_of(methods.begin(), methods.end(),
                         [](const auto &method)
                         { return method->family() == method::MethodFamily::meshfree; });
    }

    std::string names_of(const method::Methods &methods)
    {
      std::string names;
      for (const auto &method : methods)
        names += (names.empty() ? "" : ", ") + method->name();
      return names;
    }

    /// What provenance says of the work of several ranks; empty: all of it is shared, as on meshes.
    std::string work_of_ranks(const scene::Scene &scene, const method::Methods &methods)
    {
      if (!scene.domain.is_in_space())
        return repeats_work(scene, methods)
                   ? "repeated by each: lattices are not shared among ranks"
                   : "";
      const method::Methods repeated = study::repeated_by_ranks(scene, methods);
      if (repeated.empty())
        return "distributed in slabs of cells along z";
      return "repeated by each: " + names_of(repeated) +
             (repeated.size() < methods.size() ? "; others distributed in slabs of cells along z"
                                               : "");
    }

    /// Why ranks repeat work.
    void tell_repeated_work(const scene::Scene &scene, const method::Methods &methods,
                            unsigned int n_ranks)
    {
      std::cerr << "note: each of the " << n_ranks << " ranks repeats all of the work";
      if (scene.domain.is_in_space())
        std::cerr << " of " << names_of(study::repeated_by_ranks(scene, methods))
                  << "; Q1, DGQ0 and rules on the nodes of the lattice are distributed where the "
                     "domain is one box\n";
      else
        std::cerr << ", since lattices are not shared among them; one rank is as fast, and "
                     "Domain/mesh = squares is shared\n";
    }

    /// What an interrupted run of the same scene left in the folder.
    study::StudyResults earlier_results(const fs::path &folder, const scene::Scene &scene)
    {
      const fs::path file = io::results_file(folder);
      if (!fs::exists(file) || scene.study.decisive_error.target == scene::Target::finest)
        return {}; // comparisons with the method's own finest level need all solutions
      try
      {
        const study::StudyResults earlier = io::results_in(folder);
        if (!earlier.is_complete && earlier.scene_text == scene.text)
          return earlier;
      }
      catch (const InputError &)
      {
        // not ours, or of another version: it is replaced
      }
      return {};
    }

    std::string file_stem(const study::Record &run)
    {
      std::string name = run.key.problem + "_" + run.key.series + "_" + run.key.method;
      std::replace_if(
          name.begin(), name.end(),
          [](unsigned char c) { return std::isalnum(c) == 0 && c != '.'; }, '_');
      return name;
    }

    /// A failure that the scene expects ("method: failed") is no error of the run.
    bool is_expected_failure(const study::StudyResults &results, const study::Record &run)
    {
      const std::string subject =
          run.key.method + ", " + run.key.problem + ", " + run.key.series + ": verdict";
      return std::any_of(results.expectations.begin(), results.expectations.end(),
                         [&](const study::Expectation &e) {
                           return e.subject == subject &&
                                  e.expected == base::word(study::Outcome::failed) && e.holds;
                         });
    }

    int exit_code(const study::StudyResults &results, bool check)
    {
      if (!results.is_complete)
        return 130;
      for (const study::Record &run : results.records)
        if (!run.failure.empty() && !is_expected_failure(results, run))
          return 3;
      const bool holds = std::all_of(results.expectations.begin(), results.expectations.end(),
                                     [](const study::Expectation &e) { return e.holds; });
      return check && !holds ? 1 : 0;
    }

    scene::Scene read_scene(const RunOptions &options)
    {
      auto overrides = options.overrides;
      if (!options.methods.empty())
        overrides.push_back({"Methods/names", options.methods});
      if (!options.model.empty())
        overrides.push_back({"Solver/model", options.model});
      scene::Scene scene =
          study::with_names_of(scene::read_scene(options.scene_file, overrides), all_methods());
      if (scene.fracture.is_there())
        throw InputError("scene '" + scene.name +
                         "': Fracture/toughness is for 'plumbline grow', which breaks bonds; write "
                         "that, or clear it");
      return scene;
    }

    /// What the sweep goes on from: what is in the folder, with where the numbers come from.
    study::StudyResults begin_results(const fs::path &folder, const scene::Scene &scene,
                                      const method::Methods &methods,
                                      const base::Communicator &communicator)
    {
      study::StudyResults results = earlier_results(folder, scene);
      // all have read before the first one writes, and go on from the same
      const auto n_found = static_cast<double>(results.records.size());
      if (communicator.largest(n_found) != -communicator.largest(-n_found))
        results = {};
      results.provenance = provenance();
      if (const auto spectrum = study::field_spectrum(scene.random))
        results.provenance["random field"] = words_of(*spectrum);
      if (communicator.n_ranks() > 1)
        if (const std::string work = work_of_ranks(scene, methods); !work.empty())
          results.provenance["work of ranks"] = work;
      return results;
    }

    /// @param earlier  as begin_results() gives them
    void tell_beginning(const study::StudyResults &earlier, const scene::Scene &scene,
                        const method::Methods &methods, const fs::path &folder,
                        const base::Communicator &communicator, bool is_quiet)
    {
      if (!earlier.records.empty() && !is_quiet)
        std::cerr << "continuing: " << earlier.records.size() << " solves are in '"
                  << folder.string() << "' already\n";
      const auto work = earlier.provenance.find("work of ranks");
      if (communicator.rank() == 0 && work != earlier.provenance.end() &&
          work->second.find("repeated") == 0)
        tell_repeated_work(scene, methods, communicator.n_ranks());
    }

    /// On the first rank. If that fails, all ranks stop.
    void write(const base::Communicator &communicator, const std::function<void()> &action)
    {
      communicator.together(
          [&]
          {
            if (communicator.rank() == 0)
              action();
          });
    }

    /// @param points  outlive it
    study::StaticsOptions statics_options(const scene::Scene &scene, const fs::path &folder,
                                          const base::Communicator &communicator,
                                          PointValues &points)
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
        { write(communicator, [&] { points.write(found, run, folder / "points"); }); };
      }
      if (scene.output.fields)
        options.on_finest =
            [communicator, folder](const std::function<void(const std::string &)> &write_field,
                                   const study::Record &run)
        {
          write(communicator,
                [&]
                {
                  fs::create_directories(folder / "fields");
                  write_field((folder / "fields" / file_stem(run)).string());
                });
        };
      return options;
    }

    /// @param journal, progress  outlive it
    study::RunControl control_of(const RunOptions &options, const base::Communicator &communicator,
                                 io::RecordJournal &journal, ProgressLine &progress)
    {
      study::RunControl control;
      control.n_levels = options.n_levels;
      control.budget = options.budget;
      control.ranks = communicator;
      control.on_progress = [&progress](const std::string &what, double f)
      { progress.show(what, f); };
      control.on_result = [communicator, &journal](const study::StudyResults &results)
      { write(communicator, [&] { journal.append(results); }); };
      control.should_stop = [communicator] { return communicator.any(is_interrupted()); };
      return control;
    }

    /// What is wanted on standard output; what went wrong on standard error.
    void tell_end(const RunOptions &options, const study::StudyResults &results,
                  const fs::path &folder)
    {
      if (options.json)
        std::cout << std::ifstream(folder / "results.json").rdbuf();
      else if (!options.quiet)
        print_summary(results, folder);
      if (!results.is_complete)
        say_interrupted(folder);
      for (const study::Record &run : results.records)
        if (!run.failure.empty())
          std::cerr << "no solution: " << run.key.method << ", " << run.key.problem << ", "
                    << run.key.series << ", h = " << run.key.h << ": " << run.failure << '\n';
    }
  } // namespace

  int run(const RunOptions &options)
  {
    end_at_interrupts();
    if (!(options.budget >= 0))
      throw InputError("--budget is negative; give CPU seconds of a solve, or leave it out");
    const scene::Scene scene = read_scene(options);
    if (scene.time.is_dynamic())
    {
      check_analysis(scene, scene::Analysis::transient);
      return run_transient(options, scene);
    }
    // every rank runs the scene, and they share the work on meshes; the first one talks and writes
    const base::Communicator communicator = base::Communicator::all();
    const bool is_first = communicator.rank() == 0, is_quiet = options.quiet || !is_first;
    std::optional<ProgressLine> preparing(!is_quiet);
    const fs::path folder =
        options.output.empty() ? fs::path("results") / scene.name : fs::path(options.output);
    PointValues points(scene);
    const study::Analysis statics = study::statics_analysis(
        all_methods(), statics_options(scene, folder, communicator, points));
    const method::Methods methods =
        statics.choose_methods(scene, all_methods(), options.n_levels, 1);
    statics.check(scene, methods, options.n_levels);
    preparing.reset();
    const OutputFolder output(folder, {"run", scene.name, scene.text}, communicator);
    const study::StudyResults earlier = begin_results(folder, scene, methods, communicator);
    tell_beginning(earlier, scene, methods, folder, communicator, is_quiet);

    watch_interrupts();
    io::RecordJournal journal(folder / "results.jsonl", scene.text);
    study::StudyResults results;
    {
      ProgressLine progress(!is_quiet);
      study::RunControl control = control_of(options, communicator, journal, progress);
      control.earlier = earlier;
      results = run_study(statics, scene, methods, control);
    }
    write(communicator,
          [&]
          {
            report::write_report(results, folder);
            journal.remove();
          });
    if (is_first)
      tell_end(options, results, folder);
    return exit_code(results, options.check);
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
