#include "dynamics.h"

#include "base/communicator.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/number_text.h"
#include "methods.h"
#include "report/formats.h"
#include "report/frames.h"
#include "study/preflight.h"
#include "study/transient.h"
#include "work_of_ranks.h"

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
                         " would take some " + base::bytes_to_text(needed) + " in '" +
                         folder.string() + "', where " + base::bytes_to_text(free) +
                         " are free; write fewer, or give another folder with -o");
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
  } // namespace

  int run_transient(const RunOptions &options, const scene::Scene &scene)
  {
    const base::Communicator all = base::Communicator::all();
    const method::Methods methods = study::choose_methods(scene, all_methods());
    const method::Methods repeated =
        scene.domain.is_in_space() ? study::repeated_by_ranks(scene, methods) : methods;
    const bool is_shared = repeated.size() < methods.size();
    if (!is_shared && all.rank() != 0)
    {
      watch_interrupts(); // so that a signal does not end this rank; rank 0 handles it
      return 0;           // it does the work
    }
    const base::Communicator ranks = is_shared ? all : base::Communicator::alone();
    const fs::path folder = output_folder(options.output, scene);
    on_first_rank(ranks, [&] { check_frames(scene, methods, folder); });
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
    AnalysisRow row{study::transient_analysis(all_methods(), transient), report::dynamics_view,
                    "run"};
    row.analysis.are_failures_findings = scene.time.shows_blow_up;
    row.ranks = ranks;
    if (all.n_ranks() > 1)
      row.provenance["work of ranks"] =
          is_shared ? work_of_ranks(scene, methods) : work_of_first_rank;
    if (is_shared && all.n_ranks() > 1 && !repeated.empty())
      row.note = repetition(scene, methods, all.n_ranks());
    return analyse([&](const study::Checkpoints &) { return row; }, options, scene);
  }
} // namespace plumbline::app
