#include "study/round_off.h"

#include "physics/load.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::study
{
  namespace
  {
    /// The smaller side of Ω's bounding box.
    double width(const problem::Problem<2> &problem)
    {
      if (problem.mesh())
      {
        const geometry::Box box = geometry::bounding_box(*problem.mesh());
        return std::min(box.upper[0] - box.lower[0], box.upper[1] - box.lower[1]);
      }
      const auto &n = problem.lattice()->n_cells();
      return problem.lattice()->h() * std::min(n[0], n[1]);
    }

    /// The least of ∫ C_aa ξ_c²: how stiff the operator is at least.
    double least_second_moment(const physics::Kernel<2> &kernel)
    {
      double least = std::numeric_limits<double>::infinity();
      for (unsigned int a = 0; a < kernel.n_components(); ++a)
        for (const auto &alpha : {std::array<int, 2>{2, 0}, std::array<int, 2>{0, 2}})
          least = std::min(least, std::abs(kernel.moment(alpha, a, a)));
      return least;
    }
  } // namespace

  double variation(const problem::Problem<2> &problem, const Solution &solution)
  {
    double most = 0;
    const unsigned int n = problem.n_components;
    for (unsigned int c = 0; c < n && !solution.averages.empty(); ++c)
    {
      double low = solution.averages[c], high = low;
      for (std::size_t i = c; i < solution.averages.size(); i += n)
      {
        low = std::min(low, solution.averages[i]);
        high = std::max(high, solution.averages[i]);
      }
      most = std::max(most, high - low);
    }
    return most;
  }

  double round_off_error(const problem::Problem<2> &problem, const Solution &solution)
  {
    constexpr double safety = 10, epsilon = std::numeric_limits<double>::epsilon();
    const double a = width(problem) / 2 + problem.horizon();
    const double amplification =
        physics::operator_scale(problem.kernel) * a * a / least_second_moment(problem.kernel);
    double largest = 0;
    for (const double average : solution.averages)
      largest = std::max(largest, std::abs(average));
    const double residual = std::max(solution.diagnostics.relative_residual, epsilon);
    const double solved_for = problem.lattice() ? variation(problem, solution) : largest;
    const double loaded_by = problem.is_load_given ? solved_for : largest; // manufactured from u
    return safety * (epsilon * (amplification * loaded_by + largest) + residual * solved_for);
  }
} // namespace plumbline::study
