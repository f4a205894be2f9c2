#include "study/statics_in_space.h"

#include "analysis/statics.h"
#include "base/error.h"
#include "geometry/node_planes.h"
#include "method/another_operator.h"
#include "physics/gauss.h"
#include "study/compared_case.h"
#include "study/comparison.h"
#include "study/energy.h"
#include "study/estimate_cost.h"
#include "study/estimate_in_space.h"
#include "study/maps_in_space.h"
#include "study/preflight.h"
#include "study/reference_estimate.h"
#include "study/round_off.h"
#include "study/slabs_in_space.h"
#include "study/solution_record.h"
#include "study/truncation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace plumbline::study
{
  namespace
  {
    using ProblemInSpace = problem::Problem<3>;
    using analysis::SolutionInSpace;
    using scene::Quantity;
    using scene::Target;

    // On several ranks each has the averages over the cells of its slab, see analysis::solve.
    using base::Communicator;
    using method::slabs_of_cells;

    /// Averages of a field over the cells of Ω, shape (n_cells, n_components): exact for
    /// polynomials of degree 9 in each variable.
    std::vector<double> cell_averages(const problem::Field<3> &field, const ProblemInSpace &problem,
                                      const Communicator &ranks)
    {
      constexpr unsigned int n_points = 5;
      const auto &gauss = physics::gauss(n_points);
      physics::AxisFunctionals means;
      const auto planes = slabs_of_cells(problem.lattice, ranks).owned();
      const auto cells = geometry::planes_of(geometry::cell_centres(problem.lattice), planes);
      for (unsigned int d = 0; d < 3; ++d)
      {
        const auto [first, second] = d == 2 ? planes : std::pair(0, problem.lattice.n_cells()[d]);
        for (int i = first; i < second; ++i)
        {
          physics::AxisFunctional mean;
          for (unsigned int q = 0; q < n_points; ++q)
            mean.emplace_back(problem.lattice.coordinate(d, i + gauss.point(q)[0]),
                              gauss.weight(q));
          means[d].push_back(std::move(mean));
        }
      }
      std::vector<double> result(cells.n_free() * problem.n_components);
      for (unsigned int c = 0; c < problem.n_components; ++c)
      {
        const auto of_component = field.apply(c, means, cells.is_free);
        std::size_t place = c;
        for_each_cell(
            problem.lattice, planes,
            [&](const std::array<int, 3> &cell)
            {
              result[place] =
                  of_component[problem.lattice.number({cell[0], cell[1], cell[2] - planes.first})];
              place += problem.n_components;
            });
      }
      return result;
    }

    using CaseInSpace = ComparedCase<ProblemInSpace>;
    using CasesInSpace = std::vector<CaseInSpace>;

    /// All cases of a level in space.
    class LevelInSpace
    {
    public:
      LevelInSpace(const Place &place, const Methods &available, const StaticsOptions &options)
          : place_(place), scene_(place.scene()), available_(available), options_(options),
            ranks_(scene_.domain.mesh.is_lattice() && !has_energy(scene_.study.norms)
                       ? options.ranks
                       : Communicator::alone()),
            cases_(place.shared<CasesInSpace>("cases in space", [this] { return open(); }))
      {
      }

      Records run(const Method &method) const
      {
        Records records;
        for (const CaseInSpace &one : cases_)
        {
          records.push_back(place_.record("statics", method));
          records.back().key.problem = one.name;
          place_.fill(records.back(),
                      [&](Record &record)
                      {
                        const SolutionInSpace solution =
                            analysis::solve(method, one.problem, ranks_);
                        evaluate(one, solution, record);
                        enter_truncation(method, scene_.study.norms, one.problem, record);
                        enter_energies(method, scene_.study.norms, one.problem, solution.nodes,
                                       solution.nodal, record, ranks_);
                        tell_values(method, one, solution, record);
                      });
        }
        return records;
      }

    private:
      CasesInSpace open() const
      {
        return open_cases<ProblemInSpace>(
            scene_,
            [&](unsigned int c, const CasesInSpace &before)
            {
              const scene::CellsInSpace cells =
                  before.empty() ? nullptr : before.front().problem.cells;
              return make_problem_in_space(scene_, c, place_.level(), 0, nullptr, cells);
            },
            [&](const auto &field, const ProblemInSpace &problem)
            { return cell_averages(field, problem, ranks_); },
            [&](const CaseInSpace &one)
            { return cost_of_estimates().timed([&] { return solve_reference(one); }); });
      }

      EstimateCost &cost_of_estimates() const
      {
        return place_.kept<EstimateCost>(EstimateCost::name);
      }

      std::vector<double> solve_reference(const CaseInSpace &one) const
      {
        const auto method = find_method(available_, *scene_.reference.method, "Reference/method");
        const SolutionInSpace solution = analysis::solve(*method, one.problem, ranks_);
        const auto points = options_.points_in_space ? options_.points_in_space(one.problem)
                                                     : std::vector<dealii::Point<3>>{};
        const auto tell = [&](std::vector<double> errors)
        {
          if (!points.empty())
            options_.on_values(values_at(points, one.problem, solution, std::move(errors)),
                               reference_record(place_, *method, one.name));
        };
        if (scene_.reference.estimate == scene::Estimate::none)
        {
          tell({});
          return solution.averages;
        }
        const ErrorEstimate estimate = placed(
            estimate_in_space(*method, one.problem, solution, ranks_, points), place_, one.name);
        tell(estimate.at_points);
        place_.results().references.push_back(estimate);
        const double size = averages_l2(one.problem, ranks_, solution.averages);
        check_tolerance(scene_.reference, estimate, size, "a smaller h, or a larger tolerance");
        return solution.averages;
      }

      void evaluate(const CaseInSpace &one, const SolutionInSpace &solution, Record &run) const
      {
        const ProblemInSpace &problem = one.problem;
        run.cost = solution.cost;
        run.set("variation", variation(problem.n_components, solution.averages, ranks_));
        run.set("round-off", round_off_error(problem, solution, ranks_));
        run.set("area", cell_volume(problem) * static_cast<double>(problem.lattice.size()),
                "length^3");
        set_diagnostics(run, solution.diagnostics);
        one.for_each_target(
            [&](Target target, const std::vector<double> &averages)
            {
              set_errors(run, Quantity::averages, target, problem.n_components, solution.averages,
                         averages);
            });
        if (problem.solution)
          set_errors(run, Quantity::nodal, Target::exact, problem.n_components, solution.nodal,
                     nodal_values(*problem.solution, problem.n_components, solution),
                     solution.volumes);
        if (problem.local_solution)
          set_errors(run, Quantity::nodal, Target::local, problem.n_components, solution.nodal,
                     nodal_values(*problem.local_solution, problem.n_components, solution),
                     solution.volumes);
        if (place_.is_finest())
          finish_series(one, solution, run);
      }

      /// The estimate of its error, where one is wanted, and values at points, where there are
      /// some.
      void tell_values(const Method &method, const CaseInSpace &one,
                       const SolutionInSpace &solution, const Record &run) const
      {
        const ProblemInSpace &problem = one.problem;
        const auto points = options_.points_in_space ? options_.points_in_space(problem)
                                                     : std::vector<dealii::Point<3>>{};
        const bool is_shown = is_estimated(scene_, method),
                   is_at_points = !points.empty() && method::is_reference(method) &&
                                  scene_.reference.estimate != scene::Estimate::none;
        std::vector<double> errors;
        if (is_shown || is_at_points)
        {
          const ErrorEstimate found = cost_of_estimates().timed(
              [&] { return estimate_in_space(method, problem, solution, ranks_, points); });
          errors = found.at_points;
          if (is_shown)
            place_.results().estimates.push_back(placed(found, place_, one.name));
        }
        if (!points.empty())
          options_.on_values(values_at(points, problem, solution, std::move(errors)), run);
      }

      /// What is done with a solution of the finest level: stored, and drawn for the first series.
      void finish_series(const CaseInSpace &one, const SolutionInSpace &solution,
                         const Record &run) const
      {
        if (options_.on_finest)
        {
          std::vector<double> gathered; // on the first rank, which writes
          if (ranks_.n_ranks() > 1)
            gathered =
                fetch_averages(one.problem.lattice, one.problem.n_components,
                               slabs_of_cells(one.problem.lattice, ranks_), solution.averages,
                               [&](unsigned int rank) -> base::Slabs::Range {
                                 return {0, rank == 0 ? one.problem.lattice.n_cells()[2] : 0};
                               });
          const auto &all = ranks_.n_ranks() > 1 ? gathered : solution.averages;
          options_.on_finest([&](const std::string &stem)
                             { method::write_vti(one.problem, all, stem + ".vti"); },
                             run);
        }
        if (one.drawn() && is_drawn(place_, run))
          draw(one, solution, run);
      }

      void draw(const CaseInSpace &one, const SolutionInSpace &solution, const Record &run) const
      {
        for (ErrorMap &map : maps_of_layers(one.problem, ranks_, solution.averages, *one.drawn()))
          add_map(place_, std::move(map), run);
        add_grid(
            place_, [&] { return solution_grid(one.problem, ranks_, solution.averages); }, run);
      }

      std::vector<double> nodal_values(const problem::Field<3> &field, unsigned int n_components,
                                       const SolutionInSpace &solution) const
      {
        std::vector<double> values;
        for (const auto &node : solution.nodes)
          for (unsigned int c = 0; c < n_components; ++c)
            values.push_back(field.value(node, c));
        return values;
      }

      /// Of the scene's norms.
      /// @param found    of this rank, as the others
      /// @param volumes  that values stand for, shape (n_places); empty: equal parts of Ω
      void set_errors(Record &run, Quantity quantity, Target target, unsigned int n_components,
                      const std::vector<double> &found, const std::vector<double> &right,
                      const std::vector<double> &volumes = {}) const
      {
        double largest = 0, squares = 0;
        for (std::size_t i = 0; i < found.size(); ++i)
        {
          const double weight = volumes.empty() ? 1 : volumes[i / n_components];
          largest = std::max(largest, std::abs(found[i] - right[i]));
          squares += weight * std::pow(found[i] - right[i], 2);
        }
        largest = ranks_.largest(largest);
        squares = ranks_.sum(squares);
        const double n_places = ranks_.sum(static_cast<double>(found.size())) / n_components,
                     l2 = std::sqrt(volumes.empty() ? squares * run["area"] / n_places : squares);
        for (const scene::Norm norm : scene_.study.norms)
          if (scene::quantity(norm) == quantity)
          {
            const std::string name = scene::DecisiveError{norm, target}.text();
            const double value = scene::is_largest(norm) ? largest : l2;
            if (!std::isfinite(value) || !std::isfinite(squares)) // maxima lose NaN
              throw NumericalError("the error " + name + " is not a finite number");
            run.set(name, value);
          }
      }

      const Place &place_;
      const scene::Scene &scene_;
      const Methods &available_;
      const StaticsOptions &options_;
      Communicator ranks_; ///< that share what is solved
      const CasesInSpace &cases_;
    };
  } // namespace

  void open_statics_in_space(const Place &place, const Methods &available,
                             const StaticsOptions &options)
  {
    LevelInSpace(place, available, options);
  }

  Records statics_in_space(const Place &place, const Method &method, const Methods &available,
                           const StaticsOptions &options)
  {
    return LevelInSpace(place, available, options).run(method);
  }
} // namespace plumbline::study
