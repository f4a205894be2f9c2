#include "stability.h"

#include "base/cost.h"
#include "base/error.h"
#include "meshfree/vtu.h"
#include "method/discretisation.h"
#include "methods.h"
#include "output_folder.h"
#include "report/formats.h"
#include "report/stability_page.h"
#include "run_parts.h"
#include "scene/models/model.h"
#include "study/preflight.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>

namespace plumbline::app
{
  namespace fs = std::filesystem;
  using study::StabilityRow;

  namespace
  {
    /// The modes of one level, each to a file.
    void write_modes(const StabilityRow &row, const fs::path &folder)
    {
      const study::Modes &modes = row.stability.modes;
      for (std::size_t k = 0; k < modes.values.size(); ++k)
      {
        std::vector<dealii::DataOutBase::Patch<0, 2>> points(modes.nodes.size());
        for (unsigned int i = 0; i < points.size(); ++i)
        {
          points[i].vertices[0] = modes.nodes[i];
          points[i].patch_index = i;
          points[i].data.reinit(modes.n_components, 1);
          for (unsigned int c = 0; c < modes.n_components; ++c)
            points[i].data(c, 0) = static_cast<float>(modes.values[k][i * modes.n_components + c]);
        }
        fs::create_directories(folder);
        const std::string name = report::slug(row.method) + "_" + report::slug(row.series) +
                                 (k > 0 ? "_" + std::to_string(k + 1) : "");
        meshfree::write_vtu(points, modes.n_components, (folder / (name + ".vtu")).string());
      }
    }

    StabilityRow measure_level(const method::Method &method, const scene::Problem &problem,
                               const std::string &series, const scene::Level &level, double density)
    {
      StabilityRow row{method.name(), method.side(), series, level.h, level.horizon, {}, {}, {}};
      row.value = level.value;
      const base::CpuTimer timer;
      try
      {
        const auto discretisation = method.discretise(problem, base::Communicator::alone());
        const method::DiscreteOperator matrix = discretisation->matrix();
        if (matrix.size() == 0)
          throw InputError("Methods/names: '" + method.name() +
                           "' shows no operator, so nothing can be measured; leave it out "
                           "(--methods)");
        row.stability = analysis::measure(matrix);
        row.stability.diagnostics = discretisation->diagnostics();
        row.consistency = analysis::check_consistency(matrix, problem);
        row.steps = study::critical_steps(*discretisation, problem, row.stability, density);
      }
      catch (const NumericalError &error)
      {
        row.failure = error.what();
      }
      row.seconds = timer.seconds();
      return row;
    }

    /// Waves on strains in all directions, by all methods.
    void add_strains(const method::Methods &methods, const scene::Case &one,
                     const std::string &series, std::vector<study::StrainGrowth> &strains)
    {
      auto own = study::strain_growths(one.scene, series, one.level());
      for (const auto &method : methods)
        study::add_growth(*method, one.problem, one.scene.time.density, own);
      std::move(own.begin(), own.end(), std::back_inserter(strains));
    }

    /// Whether verdicts are as the scene expects; says which are not.
    bool hold(const scene::Scene &scene, const study::StabilityResults &results)
    {
      const std::vector<study::StabilityVerdict> &verdicts = results.verdicts;
      bool all_hold = true;
      for (const study::Expectation &one : study::check_growth(scene, results.strains))
        if (!one.holds)
        {
          all_hold = false;
          std::cerr << "not as expected: " << one.subject << ": found " << one.found << '\n';
        }
      for (const scene::Expected &expected : scene.expected.all)
      {
        if (expected.kind != scene::ExpectedKind::stability)
          continue;
        const auto found =
            std::find_if(verdicts.begin(), verdicts.end(),
                         [&](const auto &verdict) { return verdict.method == expected.method; });
        if (found != verdicts.end() && base::word(found->verdict) == expected.verdict)
          continue;
        all_hold = false;
        std::cerr << "not as expected: " << expected.text << ": found "
                  << (found == verdicts.end() ? "no such method" : base::word(found->verdict))
                  << '\n';
      }
      return all_hold;
    }
  } // namespace

  study::StabilityResults
  measure_stability(scene::Scene scene, const method::Methods &methods, unsigned int n_levels,
                    const StabilityControl &control,
                    const std::function<void(const StabilityRow &)> &on_finest)
  {
    scene.solver.is_mixed = false; // the operator on displacements is measured
    study::StabilityResults results;
    results.scene_name = scene.name;
    results.purpose = scene.purpose;
    results.variable = scene.study.variable;
    std::vector<std::vector<StabilityRow>> rows(methods.size()); // of each method
    const ShouldStop stops = noting(control.should_stop, results.is_complete);
    for_each_level(
        scene, n_levels,
        [&](const scene::Series &series, const scene::Level &level, bool is_finest)
        {
          const scene::Scene here = at_level(scene, level);
          const scene::Case one = scene::make_case(here, 0, level);
          for (std::size_t i = 0; i < methods.size(); ++i)
          {
            if (stops())
              return;
            const auto known =
                known_rows(control.earlier, series.name, level,
                           [&](const StabilityRow &row) {
                             return row.method == methods[i]->name() && row.value == level.value;
                           });
            rows[i].push_back(!known.empty() ? known.front()
                                             : measure_level(*methods[i], one.problem, series.name,
                                                             level, here.time.density));
            if (known.empty() && control.on_rows)
              control.on_rows({rows[i].back()});
            if (is_finest && on_finest)
              on_finest(rows[i].back());
          }
          if (is_finest && !scene.material.model->is_linear() && scene.domain.is_periodic)
            add_strains(methods, one, series.name, results.strains);
        },
        stops);
    for (auto &own : rows)
    {
      if (own.empty())
        continue;
      results.verdicts.push_back(study::judge(own, results.variable));
      std::move(own.begin(), own.end(), std::back_inserter(results.rows));
    }
    if (results.variable.empty()) // else no length varies, which powers would be of
      results.trends = study::stability_trends(results.rows);
    return results;
  }

  int stability(const StabilityOptions &options)
  {
    const scene::Scene scene = read_alone(options);
    check_analysis(scene, scene::Analysis::stability);
    const method::Methods available = all_methods();
    const method::Methods methods = study::choose_methods(scene, available);
    study::check_memory(scene, methods, available, options.n_levels);

    const fs::path folder = output_folder(options, scene);
    const OutputFolder output(folder, {"stability", scene.name, scene.text},
                              base::Communicator::alone());
    watch_interrupts();
    report::write_file(folder / "stability.md", ""); // before the work: can it be written?
    auto journal =
        open_journal<StabilityRow>(folder / "stability.jsonl", scene.text, options.quiet);
    const study::StabilityResults results = measure_stability(
        scene, methods, options.n_levels,
        {is_interrupted, [&](const auto &rows) { journal.append(rows); }, journal.earlier()},
        [&](const StabilityRow &row) { write_modes(row, folder / "stability"); });
    report::write_stability(results, folder);
    if (!results.is_complete)
      return say_interrupted(folder);
    journal.remove();
    if (options.json)
      std::cout << report::stability_json(results);
    else if (!options.quiet)
      std::cout << report::stability_text(results)
                << "\nwritten: " << (folder / "stability.html").string() << '\n';
    return options.check && !hold(scene, results) ? 1 : 0;
  }
} // namespace plumbline::app
