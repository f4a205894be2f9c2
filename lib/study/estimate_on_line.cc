#include "study/estimate_on_line.h"

#include "base/error.h"
#include "physics/gauss.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace plumbline::study
{
  namespace
  {
    using ProblemOnLine = problem::Problem<1>;

    /// Two norms of one thing.
    struct Norms
    {
      double averages = 0, field = 0;
    };

    /// Averages over cells that are each made of two.
    std::vector<double> of_pairs(const std::vector<double> &fine)
    {
      std::vector<double> result;
      for (std::size_t i = 0; i + 1 < fine.size(); i += 2)
        result.push_back((fine[i] + fine[i + 1]) / 2);
      return result;
    }

    /// The problem on cells of 2 h; empty if they do not fit the intervals or the horizon.
    std::optional<ProblemOnLine> doubled(const ProblemOnLine &problem)
    {
      if (2 * problem.h() > problem.horizon() * (1 + 1e-9))
        return {};
      try
      {
        ProblemOnLine coarse = at_spacing(problem, 2 * problem.h());
        if (coarse.lattice.size() > 1)
          return coarse;
      }
      catch (const InputError &) // ends that are no multiples of 2 h apart
      {
      }
      return {};
    }

    /// In L2, on cells where both fields are smooth.
    double field_l2(const ProblemOnLine &cells, const SolutionOnLine &a, const SolutionOnLine &b)
    {
      constexpr unsigned int n_points = 6; // exact for differences of degree 5
      const auto &gauss = physics::gauss(n_points);
      double squares = 0;
      cells.lattice.for_each_cell(
          [&](int cell)
          {
            for (unsigned int q = 0; q < n_points; ++q)
            {
              const double x = cells.lattice.coordinate(cell + gauss.point(q)[0]);
              squares += cells.h() * gauss.weight(q) * std::pow(a.value(x) - b.value(x), 2);
            }
          });
      return std::sqrt(squares);
    }

    /// The largest of each pair of estimates and changes times a factor.
    void raise_by_changes(std::vector<double> &estimates,
                          const std::vector<dealii::Point<1>> &points, const SolutionOnLine &a,
                          const SolutionOnLine &b, double factor)
    {
      for (std::size_t i = 0; i < points.size(); ++i)
        estimates[i] = std::max(estimates[i],
                                factor * std::abs(a.value(points[i][0]) - b.value(points[i][0])));
    }

    /// The method of degree p + 1; null if it does not support the kernel.
    std::shared_ptr<const Method> higher_degree(const Method &method, const ProblemOnLine &problem)
    {
      const auto higher = method.higher_degree();
      const auto on_line = dynamic_cast<const method::MethodOnIntervals *>(higher.get());
      return on_line != nullptr && on_line->why_not_on_intervals(problem.kernel).empty() ? higher
                                                                                         : nullptr;
    }
  } // namespace

  double averages_l2(const ProblemOnLine &problem, const std::vector<double> &a,
                     const std::vector<double> &b)
  {
    double squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      squares += std::pow(a[i] - (b.empty() ? 0 : b[i]), 2);
    return std::sqrt(problem.h() * squares);
  }

  ErrorEstimate estimate_on_line(const Method &method, const ProblemOnLine &problem,
                                 const SolutionOnLine &solution,
                                 const std::vector<dealii::Point<1>> &points)
  {
    ErrorEstimate estimate;
    estimate.method = method.name();
    estimate.h = problem.h();
    estimate.horizon = problem.horizon();
    estimate.at_points.assign(points.size(), 0);
    const ProblemOnLine halved = at_spacing(problem, problem.h() / 2);
    const SolutionOnLine fine = solve_on_line(method, halved);
    const Norms change{averages_l2(problem, solution.averages, of_pairs(fine.averages)),
                       field_l2(halved, solution, fine)};
    Norms before;
    if (const auto coarse = doubled(problem))
    {
      const SolutionOnLine on_coarse = solve_on_line(method, *coarse);
      before = {averages_l2(*coarse, on_coarse.averages, of_pairs(solution.averages)),
                field_l2(problem, on_coarse, solution)};
    }
    // averages that fall faster than the field will not go on to, see estimate_error()
    const double expected = std::pow(.5, method.order()),
                 q_field = contraction(before.field, change.field, expected),
                 q = std::max(q_field, contraction(before.averages, change.averages, expected));
    const double tolerance = problem.settings.solver.tolerance,
                 size = averages_l2(problem, solution.averages);
    estimate.h_change = change.averages;
    estimate.coarse_change = before.averages;
    conclude_from_changes(estimate, q, size, tolerance);
    estimate.field_h_change = change.field;
    estimate.field_coarse_change = before.field;
    estimate.field_rate = -std::log2(q_field);
    estimate.field_estimate =
        error_of_change(change.field, q_field) + solver_error(tolerance, size);
    raise_by_changes(estimate.at_points, points, solution, fine, error_of_change(1, q_field));
    if (const auto higher = higher_degree(method, problem))
    {
      const SolutionOnLine other = solve_on_line(*higher, problem);
      estimate.p_change = averages_l2(problem, solution.averages, other.averages);
      estimate.field_p_change = field_l2(problem, solution, other);
      estimate.estimate = std::max(estimate.estimate, error_of_change(estimate.p_change, 0) +
                                                          solver_error(tolerance, size));
      estimate.field_estimate =
          std::max(estimate.field_estimate,
                   error_of_change(estimate.field_p_change, 0) + solver_error(tolerance, size));
      estimate.certified_digits = certified_digits(estimate.estimate, size);
      raise_by_changes(estimate.at_points, points, solution, other, error_of_change(1, 0));
    }
    double largest = 0;
    for (const dealii::Point<1> &x : points)
      largest = std::max(largest, std::abs(solution.value(x[0])));
    if (!points.empty())
      raise_to_mean(estimate.at_points, solver_error(tolerance, largest));
    return estimate;
  }
} // namespace plumbline::study
