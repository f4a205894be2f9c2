#pragma once

#include <deal.II/base/point.h>

#include <utility>
#include <vector>

namespace plumbline::study
{
  /// The method of the records that values of the reference come with.
  constexpr auto reference_name = "reference";

  /// A solution at points of its domain.
  struct ValuesAtPoints
  {
    unsigned int n_components = 1;
    std::vector<double> values;   ///< shape (n_points, n_components)
    std::vector<double> exact;    ///< of the same shape; empty: not known
    std::vector<double> estimate; ///< of the error, shape (n_points); empty: none
    std::vector<double> gradient; ///< shape (n_points, n_components, dim); empty: none
  };

  /// @param estimate  as above
  template <int dim, class Problem, class Solution>
  ValuesAtPoints values_at(const std::vector<dealii::Point<dim>> &points, const Problem &problem,
                           const Solution &solution, std::vector<double> estimate)
  {
    ValuesAtPoints result;
    result.n_components = problem.n_components;
    result.estimate = std::move(estimate);
    for (const dealii::Point<dim> &x : points)
      for (unsigned int c = 0; c < problem.n_components; ++c)
      {
        result.values.push_back(solution.value(x, c));
        if (solution.gradient)
        {
          const dealii::Tensor<1, dim> gradient = solution.gradient(x, c);
          result.gradient.insert(result.gradient.end(), gradient.begin_raw(), gradient.end_raw());
        }
        if (problem.solution)
          result.exact.push_back(problem.solution->value(x, c));
      }
    return result;
  }
} // namespace plumbline::study
