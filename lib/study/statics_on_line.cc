#include "study/statics_on_line.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/number_text.h"
#include "method/another_operator.h"
#include "physics/gauss.h"
#include "scene/on_line.h"
#include "study/compared_case.h"
#include "study/comparison.h"
#include "study/estimate_on_line.h"
#include "study/preflight.h"
#include "study/reference_estimate.h"
#include "study/round_off.h"
#include "study/solution_record.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plumbline::study
{
  namespace
  {
    using ProblemOnLine = problem::Problem<1>;
    using method::MethodOnIntervals;
    using scene::Quantity;
    using scene::Target;

    const MethodOnIntervals *on_intervals(const Method &method)
    {
      return dynamic_cast<const MethodOnIntervals *>(&method);
    }

    /// As values_at() takes solutions. A method's own derivative is not asked for on a line.
    struct FieldAtPoints
    {
      const method::FieldOnLine &field;
      std::function<dealii::Tensor<1, 1>(const dealii::Point<1> &, unsigned int)> gradient = {};

      double value(const dealii::Point<1> &x, unsigned int /*component*/) const
      {
        return field.value(x[0]);
      }
    };

    /// Averages of a field over the cells of Ω: exact for polynomials of degree 15.
    std::vector<double> cell_averages(const problem::Field<1> &field, const ProblemOnLine &problem)
    {
      constexpr unsigned int n_points = 8;
      const auto &gauss = physics::gauss(n_points);
      std::vector<double> result;
      problem.lattice.for_each_cell(
          [&](int cell)
          {
            double sum = 0;
            for (unsigned int q = 0; q < n_points; ++q)
              sum += gauss.weight(q) *
                     field.value(
                         dealii::Point<1>(problem.lattice.coordinate(cell + gauss.point(q)[0])), 0);
            result.push_back(sum);
          });
      return result;
    }

    std::vector<double> nodal_values(const problem::Field<1> &field,
                                     const std::vector<double> &nodes)
    {
      std::vector<double> values;
      for (const double x : nodes)
        values.push_back(field.value(dealii::Point<1>(x), 0));
      return values;
    }

    /// Cells of a block: a curve has at most 256 points.
    int cells_per_point(int n)
    {
      constexpr int most_points = 256;
      return (n + most_points - 1) / most_points;
    }

    /// The largest error of averages in each block of cells, and the solution's mean there.
    ErrorMap curve_of(const ProblemOnLine &problem, const std::vector<double> &averages,
                      const std::vector<double> &target)
    {
      const int n = problem.lattice.n_cells(), per_block = cells_per_point(n);
      ErrorMap map;
      map.quantity = "cell averages";
      map.h = problem.h();
      map.horizon = problem.horizon();
      map.n_x = (n + per_block - 1) / per_block;
      map.n_y = 1;
      map.lower = {problem.lattice.coordinate(0), 0};
      map.upper = {problem.lattice.coordinate(per_block * static_cast<double>(map.n_x)), 0};
      map.values.assign(map.n_x, std::numeric_limits<double>::quiet_NaN());
      BlockMeans means(map.values.size());
      std::size_t place = 0;
      problem.lattice.for_each_cell(
          [&](int cell)
          {
            const auto block = static_cast<std::size_t>(cell / per_block);
            means.add(block, &averages[place], 1);
            map.values[block] =
                std::fmax(map.values[block], std::abs(averages[place] - target[place]));
            ++place;
          });
      map.solution = means.means();
      return map;
    }

    using CaseOnLine = ComparedCase<ProblemOnLine>;
    using CasesOnLine = std::vector<CaseOnLine>;

    /// All cases of a level on intervals.
    class LevelOnLine
    {
    public:
      LevelOnLine(const Place &place, const Methods &available, const StaticsOptions &options)
          : place_(place), scene_(place.scene()), available_(available), options_(options),
            cases_(place.shared<CasesOnLine>("cases on a line", [this] { return open(); }))
      {
      }

      Records run(const Method &method) const
      {
        Records records;
        for (const CaseOnLine &one : cases_)
        {
          records.push_back(place_.record("statics", method));
          records.back().key.problem = one.name;
          place_.fill(records.back(), [&](Record &record)
                      { evaluate(method, one, solve_on_line(method, one.problem), record); });
        }
        return records;
      }

    private:
      CasesOnLine open() const
      {
        return open_cases<ProblemOnLine>(
            scene_,
            [&](unsigned int c, const CasesOnLine &)
            { return make_problem_on_line(scene_, c, place_.level()); },
            cell_averages, [&](const CaseOnLine &one) { return solve_reference(one); });
      }

      std::vector<double> solve_reference(const CaseOnLine &one) const
      {
        const auto method = find_method(available_, *scene_.reference.method, "Reference/method");
        const SolutionOnLine solution = solve_on_line(*method, one.problem);
        const auto points = points_of(one.problem);
        const auto tell = [&](std::vector<double> errors)
        {
          if (!points.empty())
            options_.on_values(
                values_at(points, one.problem, FieldAtPoints{solution}, std::move(errors)),
                reference_record(place_, *method, one.name));
        };
        if (scene_.reference.estimate == scene::Estimate::none)
        {
          tell({});
          return solution.averages;
        }
        const ErrorEstimate estimate =
            placed(estimate_on_line(*method, one.problem, solution, points), place_, one.name);
        tell(estimate.at_points);
        place_.results().references.push_back(estimate);
        const double size = averages_l2(one.problem, solution.averages);
        check_tolerance(scene_.reference, estimate, size, "a smaller h, or a larger tolerance");
        return solution.averages;
      }

      void evaluate(const Method &method, const CaseOnLine &one, const SolutionOnLine &solution,
                    Record &run) const
      {
        const ProblemOnLine &problem = one.problem;
        run.cost = solution.cost;
        run.set("variation", variation(1, solution.averages));
        run.set("round-off", round_off_error(problem, solution.averages, solution.diagnostics));
        run.set("area", problem.h() * static_cast<double>(problem.lattice.size()), "length");
        set_diagnostics(run, solution.diagnostics);
        one.for_each_target(
            [&](Target target, const std::vector<double> &averages)
            { set_errors(run, Quantity::averages, target, solution.averages, averages); });
        if (problem.solution)
          set_errors(run, Quantity::nodal, Target::exact, solution.nodal,
                     nodal_values(*problem.solution, solution.nodes));
        if (problem.local_solution)
          set_errors(run, Quantity::nodal, Target::local, solution.nodal,
                     nodal_values(*problem.local_solution, solution.nodes));
        const auto points = points_of(problem);
        const bool is_shown = place_.is_finest() && is_estimated(scene_, method),
                   is_at_points = !points.empty() && method::is_reference(method) &&
                                  scene_.reference.estimate != scene::Estimate::none;
        std::vector<double> errors;
        if (is_shown || is_at_points)
        {
          const ErrorEstimate found = estimate_on_line(method, problem, solution, points);
          errors = found.at_points;
          if (is_shown)
            place_.results().estimates.push_back(placed(found, place_, one.name));
        }
        if (!points.empty())
          options_.on_values(values_at(points, problem, FieldAtPoints{solution}, std::move(errors)),
                             run);
        if (place_.is_finest())
          finish_series(one, solution, run);
      }

      std::vector<dealii::Point<1>> points_of(const ProblemOnLine &problem) const
      {
        return options_.points_on_line ? options_.points_on_line(problem)
                                       : std::vector<dealii::Point<1>>{};
      }

      /// What is done with a solution of the finest level: stored, and drawn for the first series.
      void finish_series(const CaseOnLine &one, const SolutionOnLine &solution,
                         const Record &run) const
      {
        if (options_.on_finest)
          options_.on_finest(
              [&](const std::string &stem) { method::write_csv(solution, stem + ".csv"); }, run);
        if (one.drawn() && is_drawn(place_, run))
          add_map(place_, curve_of(one.problem, solution.averages, *one.drawn()), run);
      }

      /// Of the scene's norms; each value stands for an equal part of Ω.
      void set_errors(Record &run, Quantity quantity, Target target,
                      const std::vector<double> &found, const std::vector<double> &right) const
      {
        double largest = 0, squares = 0;
        for (std::size_t i = 0; i < found.size(); ++i)
        {
          largest = std::max(largest, std::abs(found[i] - right[i]));
          squares += std::pow(found[i] - right[i], 2);
        }
        const double l2 = std::sqrt(squares * run["area"] / static_cast<double>(found.size()));
        for (const scene::Norm norm : scene_.study.norms)
          if (scene::quantity(norm) == quantity)
          {
            const std::string name = scene::DecisiveError{norm, target}.text();
            if (!std::isfinite(squares)) // maxima lose NaN
              throw NumericalError("the error " + name + " is not a finite number");
            run.set(name, scene::is_largest(norm) ? largest : l2);
          }
      }

      const Place &place_;
      const scene::Scene &scene_;
      const Methods &available_;
      const StaticsOptions &options_;
      const CasesOnLine &cases_;
    };
  } // namespace

  SolutionOnLine solve_on_line(const Method &method, const ProblemOnLine &problem)
  {
    const base::MemoryGauge memory;
    base::CpuTimer timer;
    const std::shared_ptr<const method::IntervalDiscretisation> discretisation =
        on_intervals(method)->discretise_on_intervals(problem);
    const auto system = discretisation->tangent();
    SolutionOnLine solution;
    solution.cost.setup_seconds = timer.seconds();
    timer.restart();
    const auto data = discretisation->data(problem);
    algebra::Vector u(data.load.size());
    const auto &settings = problem.settings.solver;
    const algebra::LinearSolve solved =
        system->solve(u, data.load, {settings.tolerance, settings.max_iterations});
    solution.cost.solve_seconds = timer.seconds();
    solution.cost.n_unknowns = discretisation->n_unknowns();
    solution.cost.n_bonds = solved.n_bonds;
    solution.cost.n_iterations = solved.n_iterations;
    solution.cost.peak_bytes = memory.peak_bytes();
    static_cast<method::FieldOnLine &>(solution) = data.field(u);
    solution.value = [discretisation, value = std::move(solution.value)](double x)
    { return value(x); };
    solution.diagnostics = discretisation->diagnostics();
    solution.diagnostics.relative_residual = solved.relative_residual;
    solution.diagnostics.operator_backend = solved.backend;
    return solution;
  }

  std::string refusal_on_line(const Method &method, const scene::Scene &scene,
                              const Methods &available)
  {
    const physics::Kernel<1> kernel =
        scene::make_kernel_on_line(scene, scene.study.series.front().levels.front().horizon);
    const auto why_not = [&](const Method &one)
    {
      const MethodOnIntervals *on_line = on_intervals(one);
      return on_line == nullptr ? std::string("not implemented in one dimension")
                                : on_line->why_not_on_intervals(kernel);
    };
    const std::string why = why_not(method);
    if (why.empty())
      return why;
    std::string others;
    for (const auto &one : available)
      if (one->is_in_all() && why_not(*one).empty() && one->family() == method.family())
        others += (others.empty() ? "" : ", ") + one->name();
    return why + " (Domain/dimension = 1)" +
           (others.empty() ? "; take a meshfree rule or a Galerkin method" : "; take " + others);
  }

  void open_statics_on_line(const Place &place, const Methods &available,
                            const StaticsOptions &options)
  {
    LevelOnLine(place, available, options);
  }

  Records statics_on_line(const Place &place, const Method &method, const Methods &available,
                          const StaticsOptions &options)
  {
    return LevelOnLine(place, available, options).run(method);
  }
} // namespace plumbline::study
