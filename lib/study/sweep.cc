#include "study/sweep.h"

#include "base/error.h"
#include "base/team.h"
#include "study/comparison.h"
#include "study/conclusions.h"
#include "study/preflight.h"
#include "study/reference_estimate.h"
#include "study/round_off.h"
#include "study/saving.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace plumbline::study
{
  namespace
  {
    bool is_same_run(const Run &run, const std::string &method, const std::string &problem,
                     const std::string &series, unsigned int level)
    {
      return run.method == method && run.problem == problem && run.series == series &&
             run.level == level;
    }

    /// Of a rank that failed, with others that may wait for it in the middle of a solve [s].
    constexpr double patience = 30;

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
        results_.regime = base::word(scene.study.regime);
        results_.scene_text = scene.text;
        results_.decisive_error = scene.study.decisive_error.text();
        results_.provenance = earlier.provenance;
      }

      Results run()
      {
        const auto cases = scene_.problem.case_names();
        std::size_t n_done = 0, n_all = 0;
        for (const auto &series : scene_.study.series)
          n_all += cases.size() * n_levels(series) * methods_.size();
        for (unsigned int c = 0; c < cases.size() && !is_stopped_; ++c)
          for (const auto &series : scene_.study.series)
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

      const Run *find_run(const Method &method, const std::string &name,
                          const scene::Series &series, unsigned int level) const
      {
        for (const Run &run : results_.runs)
          if (is_same_run(run, method.name(), name, series.name, level))
            return &run;
        return nullptr;
      }

      /// What this level is expected to cost, from the two before it [CPU s]; nothing if the one
      /// before was left out itself.
      std::optional<double> expected_seconds(const Method &method, const std::string &name,
                                             const scene::Series &series, unsigned int level) const
      {
        constexpr double usual_growth = 4; // unknowns, as h halves
        if (level == 0)
          return 0;
        const Run *last = find_run(method, name, series, level - 1);
        if (last == nullptr)
          return {};
        const Run *before = level < 2 ? nullptr : find_run(method, name, series, level - 2);
        const double growth = before == nullptr || before->cost.seconds() == 0
                                  ? usual_growth
                                  : last->cost.seconds() / before->cost.seconds();
        return growth * last->cost.seconds();
      }

      /// Methods that the budget allows at this level.
      Methods affordable(const std::string &name, const scene::Series &series, unsigned int level)
      {
        if (control_.budget == 0)
          return methods_;
        Methods result;
        for (const auto &method : methods_)
        {
          const auto seconds = expected_seconds(*method, name, series, level);
          const bool is_dear = !seconds || *seconds > control_.budget;
          if (!base::Team::all().any(is_dear)) // each rank has its own clock, and all must agree
          {
            result.push_back(method);
            continue;
          }
          std::ostringstream what;
          what << method->name() << ", " << name << ", " << series.name
               << ", h = " << series.levels[level].h;
          if (seconds)
            what << ": some " << *seconds << " CPU s";
          results_.left_out.push_back(what.str());
        }
        return result;
      }

      /// Take over what an earlier run of the same scene has for this level.
      bool take_earlier(const Methods &due, const std::string &name, const scene::Series &series,
                        unsigned int level)
      {
        std::vector<Run> known;
        for (const auto &method : due)
          for (const Run &run : earlier_.runs)
            if (is_same_run(run, method->name(), name, series.name, level))
              known.push_back(run);
        if (known.size() != due.size())
          return false;
        results_.runs.insert(results_.runs.end(), known.begin(), known.end());
        results_.savings = earlier_.savings; // of the first level, which is known then
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
        const Methods due = affordable(name, series, level);
        if (take_earlier(due, name, series, level))
          return;
        const scene::Level &sizes = series.levels[level];
        if (control_.on_progress)
          control_.on_progress(name + ", " + series.name + ", level " + std::to_string(level + 1) +
                                   ": load and reference",
                               static_cast<double>(n_done) / static_cast<double>(n_all));
        const scene::Problem problem = make_problem(scene_, case_index, sizes);
        Targets targets;
        if (scene_.reference.method)
        {
          ReferenceAverages reference = solve_reference(
              scene_, problem, case_index,
              *find_method(available_, *scene_.reference.method, "Reference/method"));
          results_.references.push_back(placed(reference.estimate, name, series, level));
          targets.reference = std::move(reference.averages);
        }
        if (scene_.problem.local_solution == scene::LocalSolution::computed)
          targets.local = local_averages(problem);
        for (const auto &method : due)
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
        return method.family() == "reference" && method.name() != scene_.reference.method &&
               (scene_.reference.estimate == scene::Estimate::every ||
                (scene_.reference.estimate == scene::Estimate::automatic &&
                 !scene_.reference.method && !problem.solution));
      }

      /// At the first level that is run, for the first method of each side, where it is cheap.
      bool is_saving_due(const Method &method, const Run &run) const
      {
        constexpr std::uint64_t most_bonds = 100000;
        return run.problem == scene_.problem.case_names().front() &&
               run.series == scene_.study.series.front().name && run.level == 0 &&
               run.cost.n_bonds <= most_bonds && has_fuller_model(scene_) &&
               std::none_of(results_.runs.begin(), results_.runs.end(),
                            [&](const Run &other) { return other.family == method.family(); });
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
        const auto solve = [&]
        {
          const Solution solution = solve_and_time(method, problem);
          run.cost = solution.cost;
          run.size = variation(problem, solution);
          run.round_off = round_off_error(scene_, problem, solution);
          run.diagnostics = solution.diagnostics;
          run.errors = errors(scene_, problem, solution, targets);
          for (const auto &[error, value] : run.errors)
            if (!std::isfinite(value))
              throw NumericalError("the error " + error + " is not a finite number");
          if (is_estimated(method, problem))
            results_.estimates.push_back(
                placed(estimate_error(scene_, problem, case_index, method, solution, true), name,
                       series, level));
          if (is_saving_due(method, run))
            if (const auto saving =
                    measure_saving(scene_, case_index, series.levels[level], method, solution))
              results_.savings.push_back(*saving);
          if (level + 1 == n_levels(series))
            finish_series(solution, run, problem,
                          targets.reference.empty() ? targets.local : targets.reference);
        };
        try
        {
          ranks_.team().together(solve, patience); // what one of them fails at, all have failed at
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
        if (run.problem != scene_.problem.case_names().back() ||
            run.series != scene_.study.series.front().name || (!problem.solution && target.empty()))
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
      const base::SeparateTeam ranks_{base::Team::all()};
      Results results_;
      bool is_stopped_ = false;
    };
  } // namespace

  Results run_sweep(const scene::Scene &scene, const Methods &methods, const Methods &available,
                    const SweepControl &control, const Results &earlier)
  {
    return Sweep(scene, methods, available, control, earlier).run();
  }
} // namespace plumbline::study
