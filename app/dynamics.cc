#include "dynamics.h"

#include "base/communicator.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/number_text.h"
#include "methods.h"
#include "output_folder.h"
#include "report/dynamics_page.h"
#include "report/formats.h"
#include "report/frames.h"
#include "report/motion_journal.h"
#include "run_parts.h"
#include "study/dynamics.h"
#include "study/preflight.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>

namespace plumbline::app
{
  namespace fs = std::filesystem;

  namespace
  {
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
        double area = 0;
        for (const geometry::Box &box : scene.domain.boxes.include)
          area += (box.upper[0] - box.lower[0]) *
                  (scene.domain.dimension == 1 ? h : box.upper[1] - box.lower[1]);
        n_nodes += area / (h * h);
      }
      constexpr double of_node = 50; // its place, u, its rate and indices, compressed
      const double needed = of_node * n_nodes * scene.time.n_frames *
                            static_cast<double>(methods.size()) *
                            static_cast<double>(scene.problem.case_names().size());
      const double free = base::available_disk(folder.string());
      if (needed > .5 * free)
        throw InputError("Time/frames = " + std::to_string(scene.time.n_frames) +
                         " would take some " + base::bytes_to_text(needed) + " in '" +
                         folder.string() + "', where " + base::bytes_to_text(free) +
                         " are free; write fewer, or give another folder with -o");
    }

    void write_frame(const fs::path &folder, const std::string &name,
                     const std::vector<double> &times, const study::Frame &frame)
    {
      const unsigned int n = frame.equation.n_components();
      const auto values = [n](const std::vector<double> &nodal)
      {
        return [nodal, n](std::size_t node, unsigned int component)
        { return component < n ? nodal[node * n + component] : 0; };
      };
      report::write_frame(folder, name, times, frame.equation.nodes(),
                          {{"displacement", n == 2, values(frame.equation.nodal(frame.state.u))},
                           {"velocity", n == 2, values(frame.equation.nodal(frame.state.v))}});
    }

    int exit_code(const study::DynamicResults &results, bool check)
    {
      if (!results.is_complete)
        return 130;
      for (const study::MotionRun &run : results.runs)
        if (!run.failure.empty() && !results.shows_blow_up)
          return 3;
      const bool holds = std::all_of(results.expectations.begin(), results.expectations.end(),
                                     [](const study::Expectation &e) { return e.holds; });
      return check && !holds ? 1 : 0;
    }

    /// Of each motion, those that are written.
    using FrameTimes = std::map<std::string, std::vector<double>>;

    /// @param journal, times, progress  outlive it
    study::MotionControl control_of(const RunOptions &options, const fs::path &folder,
                                    report::MotionJournal &journal, FrameTimes &times,
                                    ProgressLine &progress)
    {
      study::MotionControl control;
      control.n_levels = options.n_levels;
      control.on_progress = [&progress](const std::string &what, double f)
      { progress.show(what, f); };
      control.on_result = [&journal](const study::DynamicResults &r) { journal.append(r); };
      control.should_stop = is_interrupted;
      control.available = all_methods();
      control.on_frame = [folder, &times](const study::MotionRun &run, const study::Frame &frame)
      {
        const std::string name = report::slug(run.method + "_" + run.problem + "_" + run.series);
        times[name].push_back(frame.t);
        write_frame(folder / "frames", name, times[name], frame);
      };
      return control;
    }

    /// What is wanted on standard output; what went wrong on standard error.
    void tell_end(const RunOptions &options, const study::DynamicResults &results,
                  const fs::path &folder)
    {
      if (options.json)
        std::cout << report::dynamics_json(results);
      else if (!options.quiet)
        std::cout << report::dynamics_text(results)
                  << "\nreport: " << (folder / "dynamics.html").string() << '\n';
      if (!results.is_complete)
        say_interrupted(folder);
      for (const std::string &warning : results.warnings)
        std::cerr << "warning: " << warning << '\n';
      if (results.shows_blow_up)
        return;
      for (const study::MotionRun &run : results.runs)
        if (!run.failure.empty())
          std::cerr << "no motion: " << run.method << ", " << run.series << ", h = " << run.h
                    << ", " << run.scheme << ": " << run.failure << '\n';
    }
  } // namespace

  int run_motions(const RunOptions &options, const scene::Scene &scene)
  {
    const method::Methods methods = study::choose_methods(scene, all_methods());
    const fs::path folder =
        options.output.empty() ? fs::path("results") / scene.name : fs::path(options.output);
    check_frames(scene, methods, folder);
    study::check_motions(scene, methods, options.n_levels);
    const OutputFolder output(folder, {"run", scene.name, scene.text}, base::Communicator::all());
    if (base::Communicator::all().rank() != 0)
      return 0; // motions are not shared among ranks: the first one does them

    const study::DynamicResults earlier =
        report::read_motions(folder, study::begin_results(scene, options.n_levels));
    if (!earlier.runs.empty() && !options.quiet)
      std::cerr << "continuing: " << earlier.runs.size() << " motions are in '" << folder.string()
                << "' already\n";
    watch_interrupts();
    report::MotionJournal journal(folder);
    if (!earlier.runs.empty())
      journal.append(earlier); // so that a kill before the next motion loses none
    FrameTimes times;
    study::DynamicResults results;
    {
      ProgressLine progress(!options.quiet);
      results = study::run_motions(scene, methods,
                                   control_of(options, folder, journal, times, progress), earlier);
    }
    results.provenance = provenance();
    study::conclude(scene, results);
    report::write_dynamics(results, folder);
    if (results.is_complete)
      journal.remove();
    tell_end(options, results, folder);
    return exit_code(results, options.check);
  }
} // namespace plumbline::app
