#include "study/estimate_in_space.h"

#include "geometry/tetrahedral_domain.h"
#include "study/slabs_in_space.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plumbline::study
{
  namespace
  {
    /// Averages over the cells of a problem, each of eight cells of h / 2.
    /// @param averages  over the cells of h / 2
    std::vector<double> coarsened(std::vector<double> averages, const problem::Problem<3> &problem,
                                  const base::Communicator &ranks)
    {
      constexpr double part = 1. / 8;
      const geometry::CubeLattice &coarse = problem.lattice,
                                  &fine = coarse.at_spacing(problem.h() / 2);
      const unsigned int n_components = problem.n_components;
      const auto &n = coarse.n_cells();
      const base::Slabs slabs = method::slabs_of_cells(coarse, ranks);
      const auto halves = [&slabs](unsigned int rank) -> base::Slabs::Range {
        return {2 * slabs.owned(rank).first, 2 * slabs.owned(rank).second};
      };
      const auto planes = slabs.owned(), fine_planes = halves(ranks.rank());
      if (ranks.n_ranks() > 1)
        averages = fetch_averages(fine, n_components, method::slabs_of_cells(fine, ranks), averages,
                                  halves);
      std::vector<double> sums(static_cast<std::size_t>(n[0]) * n[1] * slabs.n_owned() *
                               n_components),
          result;
      const auto place = [&](const std::array<int, 3> &cell) {
        return coarse.number({cell[0], cell[1], cell[2] - planes.first}) * n_components;
      };
      auto average = averages.begin();
      for_each_cell(fine, fine_planes,
                    [&](const std::array<int, 3> &cell)
                    {
                      const std::size_t whole = place({cell[0] / 2, cell[1] / 2, cell[2] / 2});
                      for (unsigned int c = 0; c < n_components; ++c)
                        sums[whole + c] += part * *average++;
                    });
      for_each_cell(coarse, planes,
                    [&](const std::array<int, 3> &cell)
                    {
                      const auto sum = sums.begin() + static_cast<std::ptrdiff_t>(place(cell));
                      result.insert(result.end(), sum, sum + n_components);
                    });
      return result;
    }

    /// Estimated errors at points, from the change to h/2, each raised to at least twice the root
    /// mean square of the estimates at all points.
    /// @param contraction  of changes as h is halved
    std::vector<double> estimate_at(const std::vector<dealii::Point<3>> &points,
                                    const problem::Problem<3> &problem,
                                    const analysis::SolutionInSpace &solution,
                                    const analysis::SolutionInSpace &fine, double contraction)
    {
      std::vector<double> errors;
      double size = 0;
      for (const auto &x : points)
      {
        double change = 0;
        for (unsigned int c = 0; c < problem.n_components; ++c)
        {
          change = std::max(change, std::abs(solution.value(x, c) - fine.value(x, c)));
          size = std::max(size, std::abs(solution.value(x, c)));
        }
        errors.push_back(error_of_change(change, contraction));
      }
      for (double &error : errors)
        error += solution.diagnostics.outer_change * size;
      raise_to_mean(errors, solver_error(problem.settings.solver.tolerance, size));
      return errors;
    }
  } // namespace

  double cell_volume(const problem::Problem<3> &problem)
  {
    if (!problem.mesh)
      return std::pow(problem.h(), 3);
    return geometry::volume(*problem.mesh) / static_cast<double>(problem.lattice.size());
  }

  double averages_l2(const problem::Problem<3> &problem, const base::Communicator &ranks,
                     const std::vector<double> &a, const std::vector<double> &b)
  {
    double squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      squares += std::pow(a[i] - (b.empty() ? 0 : b[i]), 2);
    return std::sqrt(cell_volume(problem) * ranks.sum(squares));
  }

  ErrorEstimate estimate_in_space(const Method &method, const problem::Problem<3> &problem,
                                  const analysis::SolutionInSpace &solution,
                                  const base::Communicator &ranks,
                                  const std::vector<dealii::Point<3>> &points)
  {
    ErrorEstimate estimate;
    estimate.method = method.name();
    estimate.h = problem.h();
    estimate.horizon = problem.horizon();
    const analysis::SolutionInSpace fine =
        analysis::solve(method, at_spacing(problem, problem.h() / 2), ranks);
    estimate.h_change =
        averages_l2(problem, ranks, solution.averages, coarsened(fine.averages, problem, ranks));
    if (problem::has_doubled(problem))
    {
      const problem::Problem<3> coarse = at_spacing(problem, 2 * problem.h());
      estimate.coarse_change =
          averages_l2(coarse, ranks, analysis::solve(method, coarse, ranks).averages,
                      coarsened(solution.averages, coarse, ranks));
    }
    const double q = contraction(estimate.coarse_change, estimate.h_change,
                                 std::pow(.5, method.order())),
                 size = averages_l2(problem, ranks, solution.averages);
    estimate.outer_change = solution.diagnostics.outer_change * size;
    conclude_from_changes(estimate, q, size, problem.settings.solver.tolerance);
    estimate.at_points = estimate_at(points, problem, solution, fine, q);
    return estimate;
  }
} // namespace plumbline::study
