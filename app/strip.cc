#include "strip.h"

#include "base/cost.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/number_text.h"
#include "methods.h"
#include "output_folder.h"
#include "report/formats.h"
#include "report/strip_page.h"
#include "run_parts.h"
#include "strip_growth.h"
#include "study/preflight.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>

namespace plumbline::app
{
  namespace fs = std::filesystem;

  namespace
  {
    method::Methods choose(const scene::Scene &scene)
    {
      const method::Methods available = all_methods();
      const auto is_for_lattices = [](const method::Method &method)
      { return method.can().count(method::Capability::lattice) > 0; };
      for (const scene::Expected &expected : scene.expected.all)
        (void)study::find_method(available, expected.method, "Expected");
      method::Methods methods = study::named_methods(scene, available, is_for_lattices);
      for (const auto &method : methods)
        if (!is_for_lattices(*method))
          throw InputError("Methods/names: " + method->name() +
                           " is not for lattices, as strips are (Strip/length); take Galerkin "
                           "methods on quadrilaterals (Q1, DGQ1, ...) and meshfree rules");
      return methods;
    }

    /// Nothing is made before its memory is there.
    void check_size(const scene::Scene &scene, const method::Methods &methods,
                    unsigned int n_levels, unsigned int n_jobs)
    {
      constexpr double most_cells = 10000; // along a side
      for_each_level(
          scene, n_levels,
          [&](const problem::Series &, const problem::Level &level, bool)
          {
            const double m = level.horizon / level.h, n_height = scene.strip.height / level.h,
                         n_length = scene.strip.length / level.h, n_cells = n_height * n_length;
            const std::string what = "a strip of " + base::to_text(n_cells, 3) + " cells",
                              remedy = "choose a larger h (Study/h)";
            if (std::max(n_height, n_length) > most_cells)
              throw InputError(what + " has more than 10000 along a side; " + remedy);
            // as of growth: bonds with their books, and entries of the factor; or fields, and the
            // intact strip's two full matrices
            const double of_rules = 400 * .5 * M_PI * m * m * n_cells +
                                    16 * 6 * m * m * n_cells * std::log2(std::max(2., n_cells)),
                         n_across = 4 * (n_height + 2 * m),
                         of_galerkin = 16 * 300 * n_cells + 16 * n_across * n_across;
            for (const auto &method : methods)
              base::require_memory(method->family() == method::MethodFamily::meshfree ? of_rules
                                                                            : of_galerkin,
                                   what + " by " + method->name(), remedy, n_jobs);
          });
    }
  } // namespace

  namespace
  {
    /// Of rules, unless the strip has failed already.
    void add_growth(const scene::Scene &scene, study::StripRow &row)
    {
      if (row.family != method::MethodFamily::meshfree || !row.failure.empty())
        return;
      const base::CpuTimer timer;
      const auto influence = physics::influence_function(scene.kernel.profile, row.horizon);
      try
      {
        row.growth =
            grow_through_strip({row.strip,
                                scene.strip.n_growth,
                                {1, 1},
                                problem::SurfaceTerms::uncorrected,
                                find_rule(row.method).of(physics::deviatoric_kernel(influence, 1)),
                                influence,
                                scene.geometry.backend});
      }
      catch (const NumericalError &error)
      {
        row.failure = error.what();
      }
      row.seconds += timer.seconds();
    }
  } // namespace

  method::Methods strip_methods(const scene::Scene &scene, unsigned int n_levels,
                                unsigned int n_jobs)
  {
    method::Methods methods = choose(scene);
    check_size(scene, methods, n_levels, n_jobs);
    return methods;
  }

  study::StripResults stand_cracks(const scene::Scene &scene, const method::Methods &methods,
                                   unsigned int n_levels, const StripControl &control)
  {
    study::StripResults results{
        scene.name, scene.purpose, scene.strip, scene.material.lame()({}).mu, {}, {}};
    const ShouldStop stops = noting(control.should_stop, results.is_complete);
    for (const auto &method : methods)
      for_each_level(
          scene, n_levels,
          [&](const problem::Series &series, const problem::Level &level, bool)
          {
            const auto known = known_rows(control.earlier, series.name, level,
                                          [&](const study::StripRow &row)
                                          { return row.method == method->name(); });
            if (!known.empty())
            {
              results.rows.push_back(known.front());
              return;
            }
            results.rows.push_back(study::stand_crack(*method, scene, series, level));
            if (scene.strip.n_growth > 0)
              add_growth(scene, results.rows.back());
            if (control.on_rows)
              control.on_rows({results.rows.back()});
          },
          stops);
    results.limits = study::strip_limits(scene.strip, results.rows);
    return results;
  }

  int strip(const StripOptions &options)
  {
    const scene::Scene scene = read_alone(options);
    if (!scene.strip.is_there())
      throw InputError("scene '" + scene.name +
                       "': Strip/length is 0, so that there is no strip; give it and Strip/crack, "
                       "or use 'plumbline run'");
    const method::Methods methods = strip_methods(scene, options.n_levels);
    const fs::path folder = output_folder(options, scene);
    const OutputFolder output(folder, {"strip", scene.name, scene.text},
                              base::Communicator::alone());
    watch_interrupts();
    report::write_file(folder / "strip.md", ""); // before the work: can it be written?

    auto journal = open_journal<study::StripRow>(folder / "strip.jsonl", scene.text, options.quiet);
    const study::StripResults results = stand_cracks(
        scene, methods, options.n_levels,
        {is_interrupted, [&](const auto &rows) { journal.append(rows); }, journal.earlier()});
    const std::vector<std::string> faults = results.is_complete
                                                ? study::strip_faults(results, scene.expected)
                                                : std::vector<std::string>();
    report::write_strip(results, faults, folder);
    if (!results.is_complete)
      return say_interrupted(folder);
    journal.remove();
    if (options.json)
      std::cout << report::strip_json(results);
    else if (!options.quiet)
      std::cout << report::strip_text(results) << "\nwritten: " << (folder / "strip.html").string()
                << '\n';
    if (!options.check || faults.empty())
      return 0;
    for (const std::string &fault : faults)
      std::cerr << fault << '\n';
    return 1;
  }
} // namespace plumbline::app
