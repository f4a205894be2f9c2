#include "study/statics.h"

#include "base/communicator.h"
#include "base/error.h"
#include "method/another_operator.h"
#include "scene/on_line.h"
#include "study/compared_case.h"
#include "study/comparison.h"
#include "study/conclusions.h"
#include "study/contradiction.h"
#include "study/energy.h"
#include "study/estimate_cost.h"
#include "study/motion_norms.h"
#include "study/node_warnings.h"
#include "study/preflight.h"
#include "study/reference_estimate.h"
#include "study/round_off.h"
#include "study/sampling.h"
#include "study/saving.h"
#include "study/self_convergence.h"
#include "study/solution_record.h"
#include "study/statics_in_space.h"
#include "study/statics_on_line.h"
#include "study/timing.h"
#include "study/truncation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace plumbline::study
{
  namespace
  {
    constexpr auto own_finest = "own finest level"; ///< what the study keeps of it
    constexpr auto field_name = "solution";         ///< of records

    /// A reference solution at Reference/mesh size.
    struct FixedReference
    {
      CellPieces cells;
      ReferenceAverages solution;
    };
    /// Of each case and horizon.
    using FixedReferences = std::map<std::pair<std::string, double>, FixedReference>;

    /// A case of a level, and what its solutions are held against.
    struct OpenCase : scene::Case
    {
      std::string name;
      unsigned int number = 0; ///< of the case
      Targets targets = {};
      const FixedReference *fixed = nullptr; ///< null: the reference has the level's mesh size
    };
    using OpenCases = std::vector<OpenCase>;
    constexpr auto fixed_references =
        "references at Reference/mesh size"; ///< what the study keeps of them

    /// All cases of a level.
    class LevelOfStatics
    {
    public:
      LevelOfStatics(const Place &place, const Methods &available, const StaticsOptions &options)
          : place_(place), scene_(place.scene()), available_(available), options_(options),
            results_(place.results()),
            cases_(place.shared<OpenCases>("cases", [this] { return open_cases(); }))
      {
      }

      /// Of the finest level, where the horizon is the shortest and limits are near.
      void warn() const
      {
        if (!place_.is_finest() || !is_of_first_series())
          return;
        const auto add = [&](const std::string &text)
        {
          auto &all = results_.warnings; // an earlier study may have it
          if (std::find(all.begin(), all.end(), text) == all.end())
            all.push_back(text);
        };
        if (const auto spectrum = field_spectrum(scene_.random); spectrum && spectrum->is_grey())
          add("Random/modes: " + words_of(*spectrum));
        for (const std::string &text : node_warnings(cases_.front(), place_.methods()))
          add(text);
        for (const OpenCase &one : cases_)
          if (const auto found = measure_contradiction(one.problem); found && found->is_clear())
            add(one.name + ": " + found->text());
      }

      /// All cases by one discretisation; where ranks share its work, and all must fail alike, one
      /// by one.
      Records run(const Method &method) const
      {
        const bool is_alone =
            base::Communicator::all().n_ranks() == 1 || cases_.front().problem.lattice() != nullptr;
        std::vector<analysis::Outcome> solved;
        Records records;
        for (std::size_t i = 0; i < cases_.size(); ++i)
        {
          records.push_back(empty_record(method, cases_[i]));
          place_.fill(records.back(),
                      [&](Record &record)
                      {
                        if (!is_alone)
                          solved = solve_cases(method, {&cases_[i].problem});
                        else if (solved.empty())
                          solved = solve_cases(method, problems());
                        const analysis::Outcome &outcome = solved[is_alone ? i : 0];
                        if (!outcome.solution)
                          std::rethrow_exception(outcome.failure);
                        evaluate(method, cases_[i], *outcome.solution, record);
                      });
        }
        return records;
      }

    private:
      bool is_of_first_series() const
      {
        return place_.series().name == scene_.study.series.front().name;
      }

      EstimateCost &cost_of_estimates() const
      {
        return place_.kept<EstimateCost>(EstimateCost::name);
      }

      OpenCases open_cases() const
      {
        OpenCases cases;
        const auto names = scene_.problem.case_names();
        for (unsigned int c = 0; c < names.size(); ++c)
          cases.push_back({make_case(scene_, c, place_.level()), names[c], c});
        for (OpenCase &one : cases)
        {
          if (scene_.reference.method)
            set_reference(one);
          if (scene_.problem.local_solution == scene::LocalSolution::computed)
            one.targets.local = local_averages(one.problem);
        }
        return cases;
      }

      void set_reference(OpenCase &one) const
      {
        const double h = scene_.reference.h;
        if (h == 0)
        {
          one.targets.reference = solve_reference(one, one.name).averages;
          return;
        }
        problem::Level level = place_.level();
        level.h = h;
        auto &all = place_.kept<FixedReferences>(fixed_references);
        auto found = all.find({one.name, level.horizon});
        if (found == all.end())
        {
          const scene::Case fine = make_case(scene_, one.number, level);
          found = all.emplace(std::pair(one.name, level.horizon),
                              FixedReference{comparison_pieces(fine.problem),
                                             solve_reference(fine, one.name)})
                      .first;
        }
        one.fixed = &found->second;
        one.targets.reference =
            transferred_averages(one.fixed->cells, one.fixed->solution.averages,
                                 comparison_pieces(one.problem), one.problem.n_components);
      }

      ReferenceAverages solve_reference(const scene::Case &one, const std::string &name) const
      {
        const auto method = find_method(available_, *scene_.reference.method, "Reference/method");
        const auto points =
            options_.points ? options_.points(one.problem) : std::vector<dealii::Point<2>>{};
        ReferenceAverages reference = cost_of_estimates().timed(
            [&] { return study::solve_reference(one, *method, scene_.reference, points); });
        results_.references.push_back(placed(reference.estimate, place_, name));
        if (!points.empty())
          options_.on_values(reference.at_points, reference_record(place_, *method, name));
        return reference;
      }

      /// At the first level that is run, for the first method of each side, where it is cheap.
      bool is_saving_due(const Method &method, const OpenCase &one, const Record &record) const
      {
        constexpr std::uint64_t most_bonds = 100000;
        const auto first =
            std::find_if(place_.methods().begin(), place_.methods().end(),
                         [&](const auto &other) { return other->family() == method.family(); });
        return &one == &cases_.front() && is_of_first_series() && place_.number() == 0 &&
               record.cost.n_bonds <= most_bonds && one.full_model && first->get() == &method;
      }

      Record empty_record(const Method &method, const OpenCase &one) const
      {
        Record record = place_.record("statics", method);
        record.key.problem = one.name;
        if (const problem::MeshDomain *mesh = one.problem.on_mesh())
          record.set("geometry seconds",
                     mesh->mesh_seconds +
                         (method.family() == MethodFamily::meshfree ? mesh->cells_seconds : 0),
                     "CPU s");
        return record;
      }

      /// Everything that is known of a solution.
      void evaluate(const Method &method, const OpenCase &one, const Solution &solution,
                    Record &run) const
      {
        const problem::Problem<2> &problem = one.problem;
        run.cost = solution.cost;
        run.set("variation", variation(problem.n_components, solution.averages));
        run.set("round-off", round_off_error(problem, solution));
        run.set("area", area_of(problem), "length^2");
        set_diagnostics(run, solution.diagnostics);
        const auto found = errors(scene_.study.norms, problem, solution, one.targets);
        for (const auto &[error, value] : found)
          run.set(error, value);
        if (one.fixed != nullptr)
          run.set(distance_to_reference,
                  distance_across(comparison_pieces(problem), solution.averages, one.fixed->cells,
                                  one.fixed->solution.averages, problem.n_components));
        enter_truncation(method, scene_.study.norms, problem, run);
        enter_energies(method, scene_.study.norms, problem, solution.nodes, solution.nodal, run);
        if (options_.has_fields)
          run.fields[field_name] = field_of(problem, solution);
        if (scene_.study.decisive_error.target == scene::Target::finest)
          place_.kept<OwnFinest>(own_finest).keep(run, problem, solution.averages);
        for (const auto &[error, value] : found)
          if (!std::isfinite(value))
            throw NumericalError("the error " + error + " is not a finite number");
        const auto points =
            options_.points ? options_.points(problem) : std::vector<dealii::Point<2>>{};
        std::vector<double> at_points = estimate(method, one, solution, points);
        if (!points.empty())
          options_.on_values(values_at(points, problem, solution, std::move(at_points)), run);
        if (is_saving_due(method, one, run))
          if (const auto saving = measure_saving(one, method, solution))
            results_.savings.push_back(*saving);
        if (place_.is_finest())
          finish_series(solution, run, problem,
                        one.targets.reference.empty() ? one.targets.local : one.targets.reference);
      }

      /// Enter the estimate that the scene asks for.
      /// @return that at points
      std::vector<double> estimate(const Method &method, const OpenCase &one,
                                   const Solution &solution,
                                   const std::vector<dealii::Point<2>> &points) const
      {
        const bool is_shown = is_estimated(scene_, method),
                   is_at_points = !points.empty() && method::is_reference(method) &&
                                  scene_.reference.estimate != scene::Estimate::none;
        if (!is_shown && !is_at_points)
          return {};
        const ErrorEstimate found = cost_of_estimates().timed(
            [&]
            {
              return estimate_error(one, method, solution, true,
                                    is_at_points ? points : std::vector<dealii::Point<2>>{});
            });
        if (is_shown)
          results_.estimates.push_back(placed(found, place_, one.name));
        return found.at_points;
      }

      analysis::PointField field_of(const problem::Problem<2> &problem,
                                    const Solution &solution) const
      {
        const bool is_nodal =
            scene::quantity(scene_.study.decisive_error.norm) == scene::Quantity::nodal;
        analysis::PointField field{problem.n_components,
                                   is_nodal ? solution.nodes : comparison_points(problem),
                                   is_nodal ? solution.nodal : solution.averages};
        const double of_node = node_area(problem, solution);
        for (std::size_t i = 0; i < field.points.size(); ++i)
          field.areas.push_back(is_nodal ? of_node : cell_area(problem, i));
        return field;
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

      std::vector<const problem::Problem<2> *> problems() const
      {
        std::vector<const problem::Problem<2> *> all;
        for (const OpenCase &one : cases_)
          all.push_back(&one.problem);
        return all;
      }

      /// Of the cases by one discretisation, and what each costs.
      std::vector<analysis::Outcome>
      solve_cases(const Method &method, const std::vector<const problem::Problem<2> *> &cases) const
      {
        return solve_and_time(
            [&] {
              return options_.solve ? options_.solve(method, cases)
                                    : analysis::solve(method, cases);
            });
      }

      /// What is done with a solution of the finest level: stored, and drawn for the first series.
      void finish_series(const Solution &solution, const Record &run,
                         const problem::Problem<2> &problem,
                         const std::vector<double> &target) const
      {
        if (options_.on_finest)
          options_.on_finest([&](const std::string &stem) { solution.write_vtu(stem + ".vtu"); },
                             run);
        if (is_drawn(place_, run) && (problem.solution || !target.empty()))
          add_map(place_, error_map(scene_.study.decisive_error.norm, problem, solution, target),
                  run);
      }

      const Place &place_;
      const scene::Scene &scene_;
      const Methods &available_;
      const StaticsOptions &options_;
      StudyResults &results_;
      const OpenCases &cases_;
    };

    /// Results read case by case.
    void sort_by_case(const scene::Scene &scene, StudyResults &results)
    {
      const auto cases = scene.problem.case_names();
      const auto place = [&](const auto &one)
      {
        const auto series = std::find_if(scene.study.series.begin(), scene.study.series.end(),
                                         [&](const auto &s) { return s.name == one.series; });
        return std::tuple(std::find(cases.begin(), cases.end(), one.problem) - cases.begin(),
                          series - scene.study.series.begin(), one.level);
      };
      const auto sort = [&](auto &list, const auto &of)
      {
        std::stable_sort(list.begin(), list.end(),
                         [&](const auto &a, const auto &b) { return place(of(a)) < place(of(b)); });
      };
      const auto itself = [](const ErrorEstimate &one) -> const ErrorEstimate & { return one; };
      sort(results.records, [](const Record &one) -> const Key & { return one.key; });
      sort(results.references, itself);
      sort(results.estimates, itself);
    }
  } // namespace

  Record reference_record(const Place &place, const Method &method, const std::string &problem)
  {
    Record record = place.record("statics", method);
    record.key.problem = problem;
    record.key.method = reference_name;
    return record;
  }

  Analysis statics_analysis(const Methods &available, const StaticsOptions &options)
  {
    Analysis analysis{"statics", "Static solutions"};
    analysis.choose_methods = [options](const scene::Scene &scene, const Methods &all,
                                        unsigned int n_levels, unsigned int n_jobs)
    {
      Methods methods = study::choose_methods(scene, all);
      check_memory(scene, methods, all, n_levels, n_jobs, options.ranks.n_ranks());
      return methods;
    };
    analysis.check = [](const scene::Scene &scene, const Methods &, unsigned int)
    { check_data(scene); };
    analysis.begin = [available, options](const Place &place)
    {
      if (place.scene().domain.is_in_space())
        open_statics_in_space(place, available, options);
      else if (is_on_intervals(place.scene()))
        open_statics_on_line(place, available, options);
      else
        LevelOfStatics(place, available, options).warn();
    };
    analysis.analyse = [available, options](const Place &place, const Method &method)
    {
      return place.scene().domain.is_in_space()
                 ? statics_in_space(place, method, available, options)
             : is_on_intervals(place.scene())
                 ? statics_on_line(place, method, available, options)
                 : LevelOfStatics(place, available, options).run(method);
    };
    analysis.complete = [](const scene::Scene &scene, Common &common)
    {
      common.kept<OwnFinest>(own_finest).compare(scene, common.results.records);
      common.kept<EstimateCost>(EstimateCost::name).tell(scene, common.results);
    };
    analysis.conclude = [](const scene::Scene &scene, StudyResults &results)
    {
      sort_by_case(scene, results);
      study::conclude(scene, results);
    };
    // of errors to the own finest level samples have none: fields are compared
    analysis.sampled = {field_name, " | exact", " | local", " | reference"};
    analysis.has_decisive_error = true;
    analysis.are_failures_findings = false;
    return analysis;
  }
} // namespace plumbline::study
