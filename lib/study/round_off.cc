#include "study/round_off.h"

#include "physics/load.h"
#include "physics/load_in_space.h"

#include <algorithm>
#include <array>
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

    double width(const problem::Problem<3> &problem)
    {
      const auto &n = problem.lattice.n_cells();
      return problem.h() * *std::min_element(n.begin(), n.end());
    }

    double width(const problem::Problem<1> &problem)
    {
      return problem.h() * problem.lattice.n_cells();
    }

    template <int dim>
    double operator_scale(const problem::Problem<dim> &problem)
    {
      return physics::operator_scale(problem.kernel);
    }

    double operator_scale(const problem::Problem<1> &problem)
    {
      const physics::Kernel<1> &kernel = problem.kernel;
      const double from = std::min(.5, problem.h() / (2 * kernel.horizon()));
      return 2 * kernel.horizon() * std::abs(kernel.constant() * kernel.profile().moment(0, from));
    }

    /// The least of ∫ C_aa ξ_c²: how stiff the operator is at least.
    template <int dim>
    double least_second_moment(const physics::Kernel<dim> &kernel)
    {
      double least = std::numeric_limits<double>::infinity();
      for (unsigned int a = 0; a < kernel.n_components(); ++a)
        for (unsigned int c = 0; c < dim; ++c)
        {
          std::array<int, dim> alpha{};
          alpha[c] = 2;
          least = std::min(least, std::abs(kernel.moment(alpha, a, a)));
        }
      return least;
    }

    /// @param is_shifted  a constant is taken off before it is solved
    template <class Problem, class OneSolution>
    double round_off(const Problem &problem, const OneSolution &solution, bool is_shifted,
                     const base::Communicator &ranks)
    {
      constexpr double safety = 10, epsilon = std::numeric_limits<double>::epsilon();
      const double a = width(problem) / 2 + problem.horizon();
      const double amplification =
          operator_scale(problem) * a * a / least_second_moment(problem.kernel);
      double largest = 0;
      for (const double average : solution.averages)
        largest = std::max(largest, std::abs(average));
      largest = ranks.largest(largest);
      const double residual = std::max(solution.diagnostics.relative_residual, epsilon);
      const double solved_for =
          is_shifted ? variation(problem.n_components, solution.averages, ranks) : largest;
      const double loaded_by = problem.is_load_given ? solved_for : largest; // manufactured from u
      return safety * (epsilon * (amplification * loaded_by + largest) + residual * solved_for);
    }
  } // namespace

  double variation(unsigned int n_components, const std::vector<double> &averages,
                   const base::Communicator &ranks)
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double most = 0;
    for (unsigned int c = 0; c < n_components; ++c)
    {
      double low = infinity, high = -infinity;
      for (std::size_t i = c; i < averages.size(); i += n_components)
      {
        low = std::min(low, averages[i]);
        high = std::max(high, averages[i]);
      }
      high = ranks.largest(high);
      low = -ranks.largest(-low);
      most = std::max(most, high - low);
    }
    return most;
  }

  double round_off_error(const problem::Problem<2> &problem, const Solution &solution)
  {
    return round_off(problem, solution, problem.lattice() != nullptr, base::Communicator::alone());
  }

  double round_off_error(const problem::Problem<1> &problem, const std::vector<double> &averages,
                         const method::Diagnostics &diagnostics)
  {
    const struct
    {
      const std::vector<double> &averages;
      const method::Diagnostics &diagnostics;
    } solution{averages, diagnostics};
    return round_off(problem, solution, true, base::Communicator::alone());
  }

  double round_off_error(const problem::Problem<3> &problem,
                         const analysis::SolutionInSpace &solution, const base::Communicator &ranks)
  {
    return round_off(problem, solution, true, ranks);
  }
} // namespace plumbline::study
