#include "study/sweep.h"

#include "base/error.h"
#include "base/team.h"
#include "scene/mesh.h"
#include "study/comparison.h"
#include "study/conclusions.h"
#include "study/reference_estimate.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plumbline::study
{
  namespace
  {
    std::shared_ptr<const Method> find_method(const Methods &available, const std::string &name,
                                              const std::string &key)
    {
      std::string names;
      for (const auto &method : available)
      {
        if (method->name() == name)
          return method;
        names += (names.empty() ? "" : ", ") + method->name();
      }
      throw InputError(key + ": method '" + name + "' is not known; choose of " + names);
    }

    const char *regime_name(scene::Regime regime)
    {
      switch (regime)
      {
      case scene::Regime::m:
        return "m";
      case scene::Regime::delta:
        return "delta";
      case scene::Regime::delta_m:
        return "delta-m";
      case scene::Regime::horizon:
        break;
      }
      return "horizon";
    }

    bool is_same_run(const Run &run, const std::string &method, const std::string &problem,
                     const std::string &series, unsigned int level)
    {
      return run.method == method && run.problem == problem && run.series == series &&
             run.level == level;
    }

    /// One walk through cases, series and levels.
    class Sweep
    {
    public:
      Sweep(const scene::Scene &scene, const Methods &methods, const Methods &available,
            const SweepControl &control, const Results &earlier)
          : scene_(scene), methods_(methods), available_(available), control_(control),
            earlier_(earlier)
      {
        results_.scene_name = scene.name;
        results_.purpose = scene.purpose;
        results_.regime = regime_name(scene.regime);
        results_.scene_text = scene.text;
        results_.decisive_error = scene.decisive_error;
        results_.provenance = earlier.provenance;
      }

      Results run()
      {
        const auto cases = scene_.case_names();
        std::size_t n_done = 0, n_all = 0;
        for (const auto &series : scene_.series)
          n_all += cases.size() * n_levels(series) * methods_.size();
        for (unsigned int c = 0; c < cases.size() && !is_stopped_; ++c)
          for (const auto &series : scene_.series)
            for (unsigned int level = 0; level < n_levels(series) && !is_stopped_; ++level)
            {
              run_level(c, cases[c], series, level, n_done, n_all);
              n_done += methods_.size();
            }
        results_.is_complete = !is_stopped_;
        conclude(scene_, results_);
        return results_;
      }

    private:
      unsigned int n_levels(const scene::Series &series) const
      {
        const auto n = static_cast<unsigned int>(series.levels.size());
        return control_.n_levels == 0 ? n : std::min(n, control_.n_levels);
      }

      /// Take over what an earlier run of the same scene has for this level.
      bool take_earlier(const std::string &name, const scene::Series &series, unsigned int level)
      {
        std::vector<Run> known;
        for (const auto &method : methods_)
          for (const Run &run : earlier_.runs)
            if (is_same_run(run, method->name(), name, series.name, level))
              known.push_back(run);
        if (known.size() != methods_.size())
          return false;
        results_.runs.insert(results_.runs.end(), known.begin(), known.end());
        for (const ErrorMap &map : earlier_.maps)
          if (map.problem == name && map.series == series.name && level + 1 == n_levels(series))
            results_.maps.push_back(map);
        for (const ErrorEstimate &estimate : earlier_.references)
          if (estimate.problem == name && estimate.series == series.name && estimate.level == level)
            results_.references.push_back(estimate);
        for (const ErrorEstimate &estimate : earlier_.estimates)
          if (estimate.problem == name && estimate.series == series.name && estimate.level == level)
            results_.estimates.push_back(estimate);
        return true;
      }

      void run_level(unsigned int case_index, const std::string &name, const scene::Series &series,
                     unsigned int level, std::size_t n_done, std::size_t n_all)
      {
        if (take_earlier(name, series, level))
          return;
        const scene::Level &sizes = series.levels[level];
        if (control_.on_progress)
          control_.on_progress(name + ", " + series.name + ", level " + std::to_string(level + 1) +
                                   ": load and reference",
                               static_cast<double>(n_done) / static_cast<double>(n_all));
        const scene::Problem problem = make_problem(scene_, case_index, sizes);
        Targets targets;
        if (scene_.reference != "none")
        {
          ReferenceAverages reference =
              solve_reference(scene_, problem, case_index,
                              *find_method(available_, scene_.reference, "Reference/method"));
          results_.references.push_back(placed(reference.estimate, name, series, level));
          targets.reference = std::move(reference.averages);
        }
        if (scene_.local_solution == "computed")
          targets.local = local_averages(problem);
        for (const auto &method : methods_)
        {
          if (control_.should_stop && control_.should_stop())
          {
            is_stopped_ = true;
            return;
          }
          if (control_.on_progress)
            control_.on_progress(name + ", " + series.name + ", level " +
                                     std::to_string(level + 1) + ": " + method->name(),
                                 static_cast<double>(n_done++) / static_cast<double>(n_all));
          run_method(*method, case_index, name, series, level, problem, targets);
          if (control_.on_result)
            control_.on_result(results_);
        }
      }

      static ErrorEstimate placed(ErrorEstimate estimate, const std::string &name,
                                  const scene::Series &series, unsigned int level)
      {
        estimate.problem = name;
        estimate.series = series.name;
        estimate.level = level;
        return estimate;
      }

      /// Besides the reference.
      bool is_estimated(const Method &method, const scene::Problem &problem) const
      {
        return method.family() == "reference" && method.name() != scene_.reference &&
               (scene_.estimate == "every" || (scene_.estimate == "automatic" &&
                                               scene_.reference == "none" && !problem.solution));
      }

      void run_method(const Method &method, unsigned int case_index, const std::string &name,
                      const scene::Series &series, unsigned int level,
                      const scene::Problem &problem, const Targets &targets)
      {
        Run run;
        run.method = method.name();
        run.family = method.family();
        run.problem = name;
        run.series = series.name;
        run.level = level;
        run.h = series.levels[level].h;
        run.horizon = series.levels[level].horizon;
        try
        {
          const Solution solution = solve_and_time(method, problem);
          run.cost = solution.cost;
          for (const double average : solution.averages)
            run.size = std::max(run.size, std::abs(average));
          run.diagnostics = solution.diagnostics;
          run.errors = errors(scene_, problem, solution, targets);
          for (const auto &[error, value] : run.errors)
            if (!std::isfinite(value))
              throw NumericalError("the error " + error + " is not a finite number");
          if (is_estimated(method, problem))
            results_.estimates.push_back(
                placed(estimate_error(scene_, problem, case_index, method, solution, true), name,
                       series, level));
          if (level + 1 == n_levels(series))
            finish_series(solution, run, problem,
                          targets.reference.empty() ? targets.local : targets.reference);
        }
        catch (const NumericalError &error)
        {
          run.failure = error.what();
        }
        results_.runs.push_back(run);
      }

      /// Averages of the local limit, by classical finite elements on the mesh refined once.
      std::vector<double> local_averages(const scene::Problem &problem) const
      {
        scene::Problem fine = problem;
        fine.mesh = std::make_shared<const geometry::Mesh>(geometry::refine(*problem.mesh));
        return find_method(available_, "LOCAL", "Problem/local solution")
            ->solve(scene_, fine)
            .averages;
      }

      /// Short solves are repeated and the fastest counts: their times are mostly noise.
      Solution solve_and_time(const Method &method, const scene::Problem &problem) const
      {
        constexpr double short_seconds = .02;
        Solution solution = method.solve(scene_, problem);
        const int n_repeats = base::Team::all().n_ranks() == 1 ? 2 : 0; // ranks must agree
        for (int repeat = 0; repeat < n_repeats && solution.cost.seconds() < short_seconds;
             ++repeat)
        {
          const base::Cost again = method.solve(scene_, problem).cost;
          if (again.seconds() < solution.cost.seconds())
          {
            solution.cost.setup_seconds = again.setup_seconds;
            solution.cost.solve_seconds = again.solve_seconds;
          }
        }
        return solution;
      }

      /// What is done with a solution of the finest level: stored, and drawn for the first series.
      void finish_series(const Solution &solution, const Run &run, const scene::Problem &problem,
                         const std::vector<double> &target)
      {
        if (control_.on_finest)
          control_.on_finest(solution, run);
        if (run.problem != scene_.case_names().back() || run.series != scene_.series.front().name ||
            (!problem.solution && target.empty()))
          return;
        ErrorMap map = error_map(scene_, problem, solution, target);
        map.method = run.method;
        map.problem = run.problem;
        map.series = run.series;
        results_.maps.push_back(map);
      }

      const scene::Scene &scene_;
      const Methods &methods_, &available_;
      const SweepControl &control_;
      const Results &earlier_;
      Results results_;
      bool is_stopped_ = false;
    };
  } // namespace

  Methods choose_methods(const scene::Scene &scene, const Methods &available)
  {
    const scene::Problem problem = make_problem(scene, 0, scene.series.front().levels.front());
    Methods chosen;
    const auto add = [&](const std::shared_ptr<const Method> &method)
    {
      if (std::find(chosen.begin(), chosen.end(), method) == chosen.end())
        chosen.push_back(method);
    };
    for (const std::string &name : scene.methods)
      if (name == "all")
      {
        for (const auto &method : available)
          if (method->why_not(scene, problem).empty())
            add(method);
      }
      else
      {
        const auto method = find_method(available, name, "Methods/names");
        add(method);
        if (const std::string reason = method->why_not(scene, problem); !reason.empty())
          throw InputError("Methods/names: '" + name + "' cannot do this scene: " + reason);
      }
    if (scene.reference != "none")
    {
      const auto reference = find_method(available, scene.reference, "Reference/method");
      if (reference->family() != "reference")
        throw InputError("Reference/method: '" + scene.reference +
                         "' is no Galerkin method, so nothing is known of its error; choose Q2, P2 "
                         "or another ('plumbline list methods')");
      if (const std::string reason = reference->why_not(scene, problem); !reason.empty())
        throw InputError("Reference/method: '" + scene.reference +
                         "' cannot do this scene: " + reason);
    }
    for (const auto *list :
         {&scene.expected_verdicts, &scene.expected_errors, &scene.expected_rates,
          &scene.expected_bounds, &scene.expected_monotone, &scene.expected_stability})
      for (const scene::Expected &expected : *list)
        (void)find_method(available, expected.method, "Expected");
    return chosen;
  }

  namespace
  {
    /// The constraint is finite around Ω and the load in it, on a grid of samples.
    void check_lattice_data(const scene::Problem &problem)
    {
      constexpr int n_samples = 24;
      const geometry::Lattice &lattice = *problem.lattice;
      const auto &n = lattice.n_cells();
      const double margin = problem.horizon() / problem.h + 1;
      for (int j = 0; j <= n_samples; ++j)
        for (int i = 0; i <= n_samples; ++i)
        {
          const double s = -margin + i * (n[0] + 2 * margin) / n_samples;
          const double t = -margin + j * (n[1] + 2 * margin) / n_samples;
          const bool is_inside =
              lattice.is_inside(static_cast<int>(std::floor(s)), static_cast<int>(std::floor(t)));
          for (unsigned int component = 0; component < problem.n_components; ++component)
          {
            (void)problem.constraint.value(lattice.point(s, t), component);
            if (is_inside)
              (void)problem.load.value(lattice.point(s, t), component);
          }
        }
    }

    /// The same at nodes of a mesh problem.
    void check_node_data(const scene::Problem &problem)
    {
      constexpr std::size_t n_samples = 600;
      const auto &cells = *problem.cells;
      const std::size_t step = std::max<std::size_t>(1, cells.size() / n_samples);
      for (std::size_t i = 0; i < cells.size(); i += step)
        for (unsigned int component = 0; component < problem.n_components; ++component)
        {
          const auto &field = i < cells.n_free ? problem.load : problem.constraint;
          (void)field.value(cells.nodes[i], component);
          if (problem.coefficient)
            (void)problem.coefficient->at(cells.nodes[i]);
        }
    }
  } // namespace

  namespace
  {
    /// Meshes and nodes of all levels can be used, and differ where h does.
    void check_meshes(const scene::Scene &scene)
    {
      for (const auto &series : scene.series)
      {
        std::size_t before = 0;
        for (std::size_t i = 0; i < series.levels.size(); ++i)
        {
          const scene::Level &level = series.levels[i];
          std::ostringstream where;
          where << "level h = " << level.h << ", horizon = " << level.horizon << ": ";
          try
          {
            const geometry::Mesh mesh = make_mesh(scene, level);
            (void)make_node_cells(scene, level, mesh);
            const std::size_t n_cells = static_cast<std::size_t>(
                std::count_if(mesh.cells.begin(), mesh.cells.end(),
                              [](const geometry::MeshCell &cell) { return cell.is_inside; }));
            if (n_cells == before && level.h != series.levels[i - 1].h)
              throw InputError("Domain/mesh = " + scene.mesh.kind + " has the " +
                               std::to_string(n_cells) +
                               " cells of the level before, so that rates would mean nothing; give "
                               "a mesh that follows h, or a single value of Study/h");
            before = n_cells;
          }
          catch (const InputError &error)
          {
            throw InputError(where.str() + error.what());
          }
        }
      }
    }
  } // namespace

  void check_data(const scene::Scene &scene)
  {
    if (!scene.mesh.is_lattice())
      check_meshes(scene);
    const auto names = scene.case_names();
    for (unsigned int c = 0; c < names.size(); ++c)
      for (const auto &series : scene.series)
      {
        const scene::Level &level =
            *std::max_element(series.levels.begin(), series.levels.end(),
                              [](const scene::Level &a, const scene::Level &b)
                              { return a.horizon + a.h < b.horizon + b.h; });
        const scene::Problem problem = make_problem(scene, c, level);
        if (problem.lattice)
          check_lattice_data(problem);
        else
          check_node_data(problem);
      }
  }

  Results run_sweep(const scene::Scene &scene, const Methods &methods, const Methods &available,
                    const SweepControl &control, const Results &earlier)
  {
    return Sweep(scene, methods, available, control, earlier).run();
  }
} // namespace plumbline::study
