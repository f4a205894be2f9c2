#include "dispersion.h"

#include "base/cost.h"
#include "base/error.h"
#include "base/number_text.h"
#include "methods.h"
#include "output_folder.h"
#include "report/dispersion_page.h"
#include "report/formats.h"
#include "run_parts.h"
#include "study/preflight.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <iterator>

namespace plumbline::app
{
  namespace fs = std::filesystem;
  using study::DispersionRow;

  namespace
  {
    void check_angles(const std::vector<double> &angles)
    {
      constexpr std::size_t most = 16;
      if (angles.empty() || angles.size() > most)
        throw InputError("--angles has " + std::to_string(angles.size()) +
                         " directions; give 1 to " + std::to_string(most));
      for (const double angle : angles)
        if (!std::isfinite(angle) || std::abs(angle) > 360)
          throw InputError("--angles: " + base::to_text(angle, 4) +
                           " is no direction; give degrees from -360 to 360");
    }

    /// All that rows depend on: the finest level alone has samples.
    std::string subject_of(const DispersionOptions &options, const scene::Scene &scene)
    {
      std::string angles;
      for (const double angle : options.angles)
        angles += " " + base::to_text(angle, 17);
      return "# levels: " + std::to_string(options.n_levels) + ", angles:" + angles + "\n" +
             scene.text;
    }
  } // namespace

  study::DispersionResults measure_dispersion(const scene::Scene &scene,
                                              const method::Methods &methods,
                                              const std::vector<double> &angles,
                                              unsigned int n_levels,
                                              const DispersionControl &control)
  {
    study::DispersionResults results{
        scene.name, scene.purpose, study::plan_waves(scene, angles), {}, {}, scene.study.variable};
    const ShouldStop stops = noting(control.should_stop, results.is_complete);
    std::vector<std::vector<DispersionRow>> rows(methods.size()); // of each method
    for_each_level(
        scene, n_levels,
        [&](const scene::Series &series, const scene::Level &level, bool is_finest)
        {
          const scene::Scene here = at_level(scene, level);
          const scene::Problem problem = scene::make_problem(here, 0, level);
          study::WaveStudy waves = results.study;
          waves.density = here.time.density;
          for (std::size_t i = 0; i < methods.size() && !stops(); ++i)
          {
            const std::string name = methods[i]->name();
            auto own =
                known_rows(control.earlier, series.name, level,
                           [&](const DispersionRow &row) {
                             return row.value == level.value &&
                                    (row.method == name || row.method == study::lumped(name));
                           });
            if (own.empty())
            {
              const base::CpuTimer timer;
              own = study::measure_waves(*methods[i], problem, waves, series.name, is_finest);
              own.front().seconds = timer.seconds();
              for (DispersionRow &row : own)
                row.value = level.value;
              if (control.on_rows)
                control.on_rows(own);
            }
            std::move(own.begin(), own.end(), std::back_inserter(rows[i]));
          }
        },
        stops);
    for (auto &own : rows)
      std::move(own.begin(), own.end(), std::back_inserter(results.rows));
    results.trends = study::wave_trends(scene, results.rows);
    return results;
  }

  int dispersion(const DispersionOptions &options)
  {
    check_angles(options.angles);
    const scene::Scene scene = read_alone(options);
    (void)study::plan_waves(scene, options.angles);
    const method::Methods methods = study::choose_methods(scene, all_methods());
    const fs::path folder = output_folder(options, scene);
    const OutputFolder output(folder, {"dispersion", scene.name, scene.text},
                              base::Communicator::alone());
    watch_interrupts();
    report::write_file(folder / "dispersion.md", ""); // before the work: can it be written?
    auto journal = open_journal<DispersionRow>(folder / "dispersion.jsonl",
                                               subject_of(options, scene), options.quiet);
    const study::DispersionResults results = measure_dispersion(
        scene, methods, options.angles, options.n_levels,
        {is_interrupted, [&](const auto &rows) { journal.append(rows); }, journal.earlier()});
    report::write_dispersion(results, folder);
    if (!results.is_complete)
      return say_interrupted(folder);
    journal.remove();
    if (options.json)
      std::cout << report::dispersion_json(results);
    else if (!options.quiet)
      std::cout << report::dispersion_text(results)
                << "\nwritten: " << (folder / "dispersion.html").string() << '\n';
    return 0;
  }
} // namespace plumbline::app
