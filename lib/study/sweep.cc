#include "study/sweep.h"

#include "base/communicator.h"
#include "base/error.h"
#include "study/analysis.h"
#include "study/comparison.h"
#include "study/conclusions.h"
#include "study/contradiction.h"
#include "study/motion_norms.h"
#include "study/node_warnings.h"
#include "study/preflight.h"
#include "study/reference_estimate.h"
#include "study/round_off.h"
#include "study/sampling.h"
#include "study/saving.h"
#include "study/self_convergence.h"
#include "study/solution_record.h"
#include "study/timing.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <tuple>

namespace plumbline::study
{
  namespace
  {
    /// Of a rank that failed, with others that may wait for it in the middle of a solve [s].
    constexpr double patience = 30;

    /// One walk through cases, series and levels.
    class Sweep
    {
    public:
      Sweep(const scene::Scene &scene, const Methods &methods, const Methods &available,
            const SweepControl &control, const StudyResults &earlier)
          : scene_(scene), methods_(methods), available_(available), control_(control),
            earlier_(earlier), cases_(scene.problem.case_names())
      {
        results_.analysis = "statics";
        results_.is_complete = false;
        results_.scene_name = scene.name;
        results_.purpose = scene.purpose;
        results_.regime = scene.study.regime;
        results_.variable = scene.study.variable;
        results_.scene_text = scene.text;
        results_.decisive_error = scene.study.decisive_error.text();
        results_.provenance = earlier.provenance;
      }

      StudyResults run()
      {
        for (const auto &series : scene_.study.series)
          n_all_ += cases_.size() * n_levels(series) * methods_.size();
        for (const auto &series : scene_.study.series)
          for (unsigned int level = 0; level < n_levels(series) && !is_stopped_; ++level)
            run_level({scene_, series, level, level + 1 == n_levels(series), common_});
        results_.is_complete = !is_stopped_;
        if (!is_stopped_)
          own_finest_.compare(scene_, results_.records);
        sort_by_case();
        conclude(scene_, results_);
        return results_;
      }

    private:
      /// A case of the level that is being solved.
      struct OpenCase : scene::Case
      {
        unsigned int index; ///< of its name
        Methods due;
        Targets targets = {};
      };

      unsigned int n_levels(const problem::Series &series) const
      {
        const auto n = static_cast<unsigned int>(series.levels.size());
        return control_.n_levels == 0 ? n : std::min(n, control_.n_levels);
      }

      /// Methods that the budget allows at this level.
      Methods affordable(const std::string &name, const Place &place)
      {
        if (control_.budget == 0)
          return methods_;
        Methods result;
        for (const auto &method : methods_)
        {
          const auto seconds = expected_seconds(results_.records, method->name(), name,
                                                place.series().name, place.number());
          const bool is_dear = !seconds || *seconds > control_.budget;
          if (!base::Communicator::all().any(
                  is_dear)) // each rank has its own clock, and all must agree
          {
            result.push_back(method);
            continue;
          }
          std::ostringstream what;
          what << method->name() << ", " << name << ", " << place.series().name
               << ", h = " << place.level().h;
          if (seconds)
            what << ": some " << *seconds << " CPU s";
          results_.left_out.push_back(what.str());
        }
        return result;
      }

      /// Take over what an earlier run of the same scene has for this level.
      bool take_earlier(const Methods &due, const std::string &name, const Place &place)
      {
        if (is_against_own()) // what an earlier run held against its own finest level is not kept
          return false;
        std::vector<Record> known;
        for (const auto &method : due)
          for (const Record &run : earlier_.records)
            if (is_same_run(run, method->name(), name, place.series().name, place.number()))
              known.push_back(run);
        if (known.size() != due.size())
          return false;
        results_.records.insert(results_.records.end(), known.begin(), known.end());
        results_.savings = earlier_.savings; // of the first level, which is known then
        results_.warnings = earlier_.warnings;
        for (const ErrorMap &map : earlier_.maps)
          if (map.problem == name && map.series == place.series().name && place.is_finest())
            results_.maps.push_back(map);
        for (const ErrorEstimate &estimate : earlier_.references)
          if (estimate.problem == name && estimate.series == place.series().name &&
              estimate.level == place.number())
            results_.references.push_back(estimate);
        for (const ErrorEstimate &estimate : earlier_.estimates)
          if (estimate.problem == name && estimate.series == place.series().name &&
              estimate.level == place.number())
            results_.estimates.push_back(estimate);
        return true;
      }

      void run_level(const Place &place)
      {
        std::vector<OpenCase> open;
        const std::size_t n_before = n_done_;
        for (unsigned int c = 0; c < cases_.size(); ++c)
        {
          Methods due = affordable(cases_[c], place);
          if (take_earlier(due, cases_[c], place))
            continue;
          say(cases_[c], place, "load and reference");
          open.push_back({make_case(place.scene(), c, place.level()), c, std::move(due)});
        }
        warn(open, place);
        solve_targets(open, place);
        for (const auto &method : methods_)
          run_method(*method, open, place);
        n_done_ = n_before + cases_.size() * methods_.size();
      }

      bool is_against_own() const
      {
        return scene_.study.decisive_error.target == scene::Target::finest;
      }

      /// Of the finest level, where the horizon is the shortest and limits are near.
      void warn(const std::vector<OpenCase> &open, const Place &place)
      {
        if (open.empty() || !place.is_finest() ||
            place.series().name != scene_.study.series.front().name)
          return; // warnings of an earlier run are taken over with its cases
        if (const auto spectrum = field_spectrum(scene_.random); spectrum && spectrum->is_grey())
          results_.warnings.push_back("Random/modes: " + words_of(*spectrum));
        for (const std::string &text : node_warnings(open.front(), methods_))
          results_.warnings.push_back(text);
        for (const OpenCase &one : open)
          if (const auto found = measure_contradiction(one.problem); found && found->is_clear())
            results_.warnings.push_back(cases_[one.index] + ": " + found->text());
      }

      void say(const std::string &name, const Place &place, const std::string &what) const
      {
        if (control_.on_progress)
          control_.on_progress(name + ", " + place.series().name + ", level " +
                                   std::to_string(place.number() + 1) + ": " + what,
                               static_cast<double>(n_done_) / static_cast<double>(n_all_));
      }

      void solve_targets(std::vector<OpenCase> &open, const Place &place)
      {
        for (OpenCase &one : open)
        {
          if (scene_.reference.method)
          {
            ReferenceAverages reference = solve_reference(
                one, *find_method(available_, *scene_.reference.method, "Reference/method"),
                scene_.reference);
            results_.references.push_back(placed(reference.estimate, cases_[one.index], place));
            one.targets.reference = std::move(reference.averages);
          }
          if (scene_.problem.local_solution == scene::LocalSolution::computed)
            one.targets.local = local_averages(one.problem);
        }
      }

      /// All cases by one discretisation; on several ranks, where all must fail alike, one by one.
      void run_method(const Method &method, std::vector<OpenCase> &open, const Place &place)
      {
        std::vector<const OpenCase *> due;
        for (const OpenCase &one : open)
          if (std::any_of(one.due.begin(), one.due.end(),
                          [&](const auto &other) { return other.get() == &method; }))
            due.push_back(&one);
        if (due.empty() || is_stopped_)
          return;
        if (control_.should_stop && control_.should_stop())
        {
          is_stopped_ = true;
          return;
        }
        say(cases_[due.front()->index], place, method.name());
        const bool is_alone = base::Communicator::all().n_ranks() == 1;
        std::vector<analysis::Outcome> solved;
        if (is_alone)
          ranks_.communicator().together([&] { solved = solve_cases(method, due); });
        for (std::size_t i = 0; i < due.size(); ++i)
        {
          Record run = empty_run(method, *due[i], place);
          const auto solve = [&]
          {
            analysis::Outcome outcome =
                is_alone ? std::move(solved[i]) : solve_cases(method, {due[i]}).front();
            if (!outcome.solution)
              std::rethrow_exception(outcome.failure);
            evaluate(method, *due[i], *outcome.solution, place, run);
          };
          try
          {
            ranks_.communicator().together(solve,
                                           patience); // what one fails at, all have failed at
          }
          catch (const NumericalError &error)
          {
            run.failure = error.what();
          }
          results_.records.push_back(run);
          ++n_done_;
          if (control_.on_result)
            control_.on_result(results_);
        }
      }

      static ErrorEstimate placed(ErrorEstimate estimate, const std::string &name,
                                  const Place &place)
      {
        estimate.problem = name;
        estimate.series = place.series().name;
        estimate.level = place.number();
        return estimate;
      }

      /// Besides the reference.
      bool is_estimated(const Method &method, const problem::Problem<2> &problem) const
      {
        return method.family() == MethodFamily::reference &&
               method.name() != scene_.reference.method &&
               (scene_.reference.estimate == scene::Estimate::every ||
                (scene_.reference.estimate == scene::Estimate::automatic &&
                 !scene_.reference.method && !problem.solution));
      }

      /// At the first level that is run, for the first method of each side, where it is cheap.
      bool is_saving_due(const Method &method, const OpenCase &one, const Record &run) const
      {
        constexpr std::uint64_t most_bonds = 100000;
        return run.key.problem == cases_.front() &&
               run.key.series == scene_.study.series.front().name && run.key.level == 0 &&
               run.cost.n_bonds <= most_bonds && one.full_model &&
               std::none_of(results_.records.begin(), results_.records.end(),
                            [&](const Record &other)
                            { return other.key.family == method.family(); });
      }

      Record empty_run(const Method &method, const OpenCase &one, const Place &place) const
      {
        Record run = place.record("statics", method);
        run.key.problem = cases_[one.index];
        if (const problem::MeshDomain *mesh = one.problem.on_mesh())
          run.set("geometry seconds",
                  mesh->mesh_seconds +
                      (method.family() == MethodFamily::meshfree ? mesh->cells_seconds : 0),
                  "CPU s");
        return run;
      }

      /// Everything that is known of a solution.
      void evaluate(const Method &method, const OpenCase &one, const Solution &solution,
                    const Place &place, Record &run)
      {
        const problem::Problem<2> &problem = one.problem;
        run.cost = solution.cost;
        run.set("variation", variation(problem, solution));
        run.set("round-off", round_off_error(problem, solution));
        run.set("area", area_of(problem), "length^2");
        set_diagnostics(run, solution.diagnostics);
        const auto found = errors(scene_.study.norms, problem, solution, one.targets);
        for (const auto &[error, value] : found)
          run.set(error, value);
        if (control_.on_solution)
          control_.on_solution(problem, solution, run);
        if (is_against_own())
          own_finest_.keep(run, problem, solution.averages);
        for (const auto &[error, value] : found)
          if (!std::isfinite(value))
            throw NumericalError("the error " + error + " is not a finite number");
        if (is_estimated(method, problem))
          results_.estimates.push_back(
              placed(estimate_error(one, method, solution, true), run.key.problem, place));
        if (is_saving_due(method, one, run))
          if (const auto saving = measure_saving(one, method, solution))
            results_.savings.push_back(*saving);
        if (place.is_finest())
          finish_series(solution, run, problem,
                        one.targets.reference.empty() ? one.targets.local : one.targets.reference);
      }

      /// Averages of the local limit, by classical finite elements on the mesh refined once.
      std::vector<double> local_averages(const problem::Problem<2> &problem) const
      {
        problem::Problem<2> fine = problem;
        fine.on_mesh()->mesh =
            std::make_shared<const geometry::Mesh>(geometry::refine(*problem.mesh()));
        return analysis::solve(*find_method(available_, "LOCAL", "Problem/local solution"), fine)
            .averages;
      }

      /// Of the cases by one discretisation, and what each costs.
      std::vector<analysis::Outcome> solve_cases(const Method &method,
                                                 const std::vector<const OpenCase *> &cases) const
      {
        std::vector<const problem::Problem<2> *> problems;
        for (const OpenCase *one : cases)
          problems.push_back(&one->problem);
        return solve_and_time(
            [&] {
              return control_.solve ? control_.solve(method, problems)
                                    : analysis::solve(method, problems);
            });
      }

      /// Levels were solved for all cases at once; results read case by case.
      void sort_by_case()
      {
        const auto place = [&](const auto &one)
        {
          const auto series = std::find_if(scene_.study.series.begin(), scene_.study.series.end(),
                                           [&](const auto &s) { return s.name == one.series; });
          return std::tuple(std::find(cases_.begin(), cases_.end(), one.problem) - cases_.begin(),
                            series - scene_.study.series.begin(), one.level);
        };
        const auto sort = [&](auto &list, const auto &of)
        {
          std::stable_sort(list.begin(), list.end(),
                           [&](const auto &a, const auto &b)
                           { return place(of(a)) < place(of(b)); });
        };
        const auto itself = [](const ErrorEstimate &one) -> const ErrorEstimate & { return one; };
        sort(results_.records, [](const Record &one) -> const Key & { return one.key; });
        sort(results_.references, itself);
        sort(results_.estimates, itself);
      }

      /// What is done with a solution of the finest level: stored, and drawn for the first series.
      void finish_series(const Solution &solution, const Record &run,
                         const problem::Problem<2> &problem, const std::vector<double> &target)
      {
        if (control_.on_finest)
          control_.on_finest(solution, run);
        if (run.key.problem != cases_.back() ||
            run.key.series != scene_.study.series.front().name ||
            (!problem.solution && target.empty()))
          return;
        ErrorMap map = error_map(scene_.study.decisive_error.norm, problem, solution, target);
        map.method = run.key.method;
        map.problem = run.key.problem;
        map.series = run.key.series;
        map.size = size_of(run);
        results_.maps.push_back(map);
      }

      const scene::Scene &scene_;
      const Methods &methods_, &available_;
      const SweepControl &control_;
      const StudyResults &earlier_;
      const std::vector<std::string> cases_;
      const base::SeparateCommunicator ranks_{base::Communicator::all()};
      StudyResults results_;
      OwnFinest own_finest_;
      Common common_;
      std::size_t n_done_ = 0, n_all_ = 0;
      bool is_stopped_ = false;
    };
  } // namespace

  StudyResults run_sweep(const scene::Scene &scene, const Methods &methods,
                         const Methods &available, const SweepControl &control,
                         const StudyResults &earlier)
  {
    return Sweep(scene, methods, available, control, earlier).run();
  }
} // namespace plumbline::study
