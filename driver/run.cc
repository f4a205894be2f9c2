#include "driver/run.h"

#include "base/communicator.h"
#include "base/error.h"
#include "base/first_rank.h"
#include "base/memory.h"
#include "base/number_text.h"
#include "driver/interrupts.h"
#include "driver/methods.h"
#include "io/output_folder.h"
#include "io/point_values.h"
#include "io/record_journal.h"
#include "report/formats.h"
#include "report/frames.h"
#include "report/memory_text.h"
#include "report/pdf.h"
#include "report/view.h"
#include "scene/capabilities.h"
#include "study/memory_estimate.h"
#include "study/preflight.h"
#include "study/rank_times.h"
#include "study/sampling.h"
#include "study/statics.h"
#include "study/transient.h"
#include "study/work_of_ranks.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>

namespace plumbline::driver
{
  namespace fs = std::filesystem;

  namespace
  {
    scene::Scene read(RunOptions options)
    {
      if (!options.model.empty())
        options.overrides.push_back({"Solver/model", options.model});
      scene::Scene scene = read_scene(options);
      refuse_growth(scene);
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
        options.points_on_line = [&points](const problem::Problem<1> &problem)
        { return points.of(problem); };
        options.on_values = [communicator, folder, &points](const study::ValuesAtPoints &found,
                                                            const study::Record &run) {
          base::on_first_rank(communicator, [&] { points.write(found, run, folder / "points"); });
        };
      }
      if (scene.output.fields)
        options.on_finest =
            [communicator, folder](const std::function<void(const std::string &)> &write_field,
                                   const study::Record &run)
        {
          base::on_first_rank(communicator,
                              [&]
                              {
                                fs::create_directories(folder / "fields");
                                write_field((folder / "fields" / io::file_stem(run)).string());
                              });
        };
      return options;
    }

    /// @param points  outlive it
    Task statics_task(const scene::Scene &scene, const fs::path &folder, io::PointValues &points)
    {
      // ranks share each method's work where it can be distributed, else methods and levels
      const base::Communicator all = base::Communicator::all();
      const method::Methods methods =
          all.n_ranks() > 1 ? study::choose_methods(scene, all_methods()) : method::Methods{};
      // comparisons with the method's own finest level need all solutions
      const bool goes_on = scene.study.decisive_error.target != scene::Target::finest,
                 has_task_ranks =
                     all.n_ranks() > 1 && goes_on && !study::is_any_distributed(scene, methods);
      const base::Communicator communicator = has_task_ranks ? base::Communicator::alone() : all;
      Task task{study::statics_analysis(all_methods(),
                                        statics_options(scene, folder, communicator, points)),
                report::statics_view};
      task.command = "run";
      task.file = "results";
      if (points.is_wanted())
        task.take_over = [folder, &points](const study::StudyResults &earlier)
        { points.take_over(earlier, folder / "points"); };
      task.ranks = communicator;
      task.goes_on = goes_on;
      if (const auto spectrum = study::field_spectrum(scene.random))
        task.provenance["random field"] = words_of(*spectrum);
      if (has_task_ranks)
        share_tasks(task);
      else if (all.n_ranks() > 1)
      {
        const std::string work = study::work_of_ranks(scene, methods);
        if (!work.empty())
          task.provenance["work of ranks"] = work;
        if (work.find("repeated") == 0)
          task.note = study::repetition(scene, methods, all.n_ranks());
      }
      return task;
    }

    /// Prints the estimated memory of each rank by method and level, and on several ranks the time.
    /// @throws InputError  where it is not estimated
    void print_estimate(const RunOptions &options, const scene::Scene &scene)
    {
      if (scene.time.is_dynamic() && !scene.domain.is_in_space())
        throw InputError("--estimate: the memory of transient analyses is estimated in three "
                         "dimensions only; in the plane, run the first levels only (--levels)");
      const unsigned int n_ranks =
          options.n_ranks > 0 ? options.n_ranks : base::Communicator::all().n_ranks();
      method::Methods methods = study::choose_methods(scene, all_methods());
      if (scene.reference.method && !scene.time.is_dynamic())
      {
        const auto reference =
            study::find_method(all_methods(), *scene.reference.method, "Reference/method");
        if (std::none_of(methods.begin(), methods.end(),
                         [&](const auto &one) { return one->name() == reference->name(); }))
          methods.push_back(reference);
      }
      const auto estimates = study::estimate_memory(scene, methods, options.n_levels, n_ranks);
      const algebra::Rates rates;
      std::vector<study::TimeOfLevel> times;
      if (n_ranks > 1 && scene.domain.is_in_space())
        times = study::predict_times(scene, methods, options.n_levels, n_ranks, rates);
      if (base::Communicator::all().rank() == 0)
        // what is available is of one of the ranks that run, not of those that are not started
        std::cout << report::memory_text(estimates, n_ranks, base::available_memory(),
                                         options.n_ranks > 0 ? n_ranks : 1)
                  << report::times_text(times, n_ranks, rates);
    }

    /// Frames fill no more than half of what is free.
    void check_frames(const scene::Scene &scene, const method::Methods &methods,
                      const fs::path &folder)
    {
      if (scene.time.n_frames == 0)
        return;
      double n_nodes = 0;
      for (const problem::Series &series : scene.study.series)
      {
        const double h = series.levels.back().h;
        for (const geometry::Box &box : scene.domain.boxes.include)
          n_nodes += (box.upper[0] - box.lower[0]) / h *
                     (scene.domain.dimension == 1 ? 1 : (box.upper[1] - box.lower[1]) / h);
        for (const geometry::Cuboid &cuboid : scene.domain.solid.include)
          n_nodes += (cuboid.upper[0] - cuboid.lower[0]) / h *
                     ((cuboid.upper[1] - cuboid.lower[1]) / h) *
                     ((cuboid.upper[2] - cuboid.lower[2]) / h);
      }
      constexpr double of_node = 50; // its place, u, its rate and indices, compressed
      const double needed = of_node * n_nodes * scene.time.n_frames *
                            static_cast<double>(methods.size()) *
                            static_cast<double>(scene.problem.case_names().size());
      const double free = base::available_disk(folder.string());
      if (needed > .5 * free)
        throw InputError("Time/frames = " + std::to_string(scene.time.n_frames) +
                         " would take about " + base::bytes_to_text(needed) + " in '" +
                         folder.string() + "', where " + base::bytes_to_text(free) +
                         " are free; give a smaller number, or another folder with -o");
    }

    void write_frame(const fs::path &folder, const std::string &name,
                     const std::vector<double> &times, const study::Frame &frame)
    {
      const unsigned int n = frame.n_components;
      const auto values = [n](const std::vector<double> &nodal)
      {
        return [nodal, n](std::size_t node, unsigned int component)
        { return component < n ? nodal[node * n + component] : 0; };
      };
      report::write_frame(
          folder, name, times, frame.nodes,
          {{"displacement", n > 1, values(frame.u)}, {"velocity", n > 1, values(frame.v)}});
    }

    /// Of a scene with a time (Time/final time > 0): dynamics.html, .json, .md and dynamics/, and
    /// frames/ where Time/frames asks.
    int run_transient(const RunOptions &options, const scene::Scene &scene)
    {
      const base::Communicator all = base::Communicator::all();
      const method::Methods methods = study::choose_methods(scene, all_methods());
      const method::Methods repeated =
          scene.domain.is_in_space() ? study::repeated_by_ranks(scene, methods) : methods;
      const bool is_shared = repeated.size() < methods.size();
      const base::Communicator ranks = is_shared ? all : base::Communicator::alone();
      const fs::path folder = output_folder(options, scene);
      base::on_first_rank(all, [&] { check_frames(scene, methods, folder); });
      study::TransientOptions transient;
      transient.ranks = ranks;
      transient.on_frame = [folder, times = std::map<std::string, std::vector<double>>()](
                               const study::Record &record, const study::Frame &frame) mutable
      {
        const study::Key &key = record.key;
        const std::string name = report::slug(key.method + "_" + key.problem + "_" + key.series);
        times[name].push_back(frame.t);
        write_frame(folder / "frames", name, times[name], frame);
      };
      Task task{study::transient_analysis(all_methods(), transient), report::dynamics_view, "run"};
      task.analysis.are_failures_findings = scene.time.shows_blow_up;
      task.ranks = ranks;
      if (!is_shared)
        share_tasks(task);
      else if (all.n_ranks() > 1)
        task.provenance["work of ranks"] = study::work_of_ranks(scene, methods);
      if (is_shared && all.n_ranks() > 1 && !repeated.empty())
        task.note = study::repetition(scene, methods, all.n_ranks());
      return analyse([&](const study::Checkpoints &) { return task; }, options, scene);
    }
  } // namespace

  void refuse_growth(const scene::Scene &scene)
  {
    if (scene.fracture.is_there())
      throw InputError("scene '" + scene.name +
                       "': only 'plumbline grow' uses Fracture/toughness; run that analysis, or "
                       "clear the key");
  }

  int run(const RunOptions &options)
  {
    if (!options.is_worker)
      end_at_interrupts();
    const scene::Scene scene = read(options);
    if (options.is_estimate && options.json)
      throw InputError(
          "--estimate prints a text table and cannot be combined with --json, which prints "
          "the results of a run; leave out one of them");
    if (options.n_ranks > 0 && !options.is_estimate)
      throw InputError("--ranks = " + std::to_string(options.n_ranks) +
                       " applies only to --estimate, which runs nothing; add --estimate, or run on "
                       "that many ranks by mpirun -np " +
                       std::to_string(options.n_ranks));
    if (options.is_estimate)
    {
      print_estimate(options, scene);
      return 0; // also where it does not fit
    }
    if (scene.time.is_dynamic())
    {
      check_analysis(scene, scene::Analysis::transient);
      return run_transient(options, scene);
    }
    io::PointValues points(scene);
    return analyse([&](const study::Checkpoints &checkpoints)
                   { return statics_task(scene, checkpoints.folder, points); },
                   options, scene);
  }

  int rebuild_report(const std::string &folder, bool is_pdf)
  {
    if (is_pdf)
      report::require_pdf();
    const study::StudyResults results = io::results_in(folder);
    const io::OutputFolder output(folder, {"run", results.scene_name, results.scene_text, note},
                                  base::Communicator::alone());
    report::write_study(report::statics_view(results), results, folder);
    if (is_pdf)
      report::draw_pdf(folder);
    std::cout << "report: " << (fs::path(folder) / "report.html").string() << '\n';
    return 0;
  }
} // namespace plumbline::driver
