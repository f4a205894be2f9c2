#include "estimate_audit.h"

#include "study/reference_estimate.h"
#include "study/resized.h"

#include <algorithm>
#include <cmath>

namespace plumbline::audit
{
  namespace
  {
    /// Errors below this, relative to the solution, are the linear solver's: their ratios to
    /// estimates, ten times its tolerance then, tell nothing.
    constexpr double round_off = 1e-11;

    struct Truth
    {
      double averages, field;
    };

    Truth against_solution(const problem::Problem<2> &problem, const analysis::Solution &solution)
    {
      constexpr unsigned int degree = 14;
      const auto exact = study::cell_averages(*problem.solution, problem);
      return {study::averages_l2(problem, solution.averages, exact),
              study::field_l2(problem, solution.value, problem.solution->value, degree)};
    }

    Truth against_finer(const scene::Case &one, const method::Method &method, unsigned int n,
                        const analysis::Solution &solution)
    {
      const problem::Problem<2> &problem = one.problem;
      const auto better = method.higher_degree();
      const study::Resized fine = study::finer(one, n);
      const auto found = study::solve_resized(fine, problem, *better);
      problem::Problem<2> cells = problem; // ours in pieces, on which both fields are smooth
      if (problem.lattice())
        cells = fine.problem;
      for (unsigned int i = n; i > 1 && !problem.lattice(); i /= 2)
        cells.on_mesh()->mesh =
            std::make_shared<const geometry::Mesh>(geometry::refine(*cells.mesh()));
      return {study::averages_l2(problem, solution.averages, found.averages),
              study::field_l2(cells, solution.value, found.value, 2 * better->order())};
    }
  } // namespace

  std::vector<Entry> audit(const scene::Case &one, const method::Method &method, unsigned int n,
                           double &seconds)
  {
    const problem::Problem<2> &problem = one.problem;
    const analysis::Solution solution = analysis::solve(method, problem);
    seconds = solution.cost.seconds();
    const std::vector<double> zero(solution.averages.size());
    const double size = study::averages_l2(problem, solution.averages, zero);
    const Truth truth = problem.solution ? against_solution(problem, solution)
                                         : against_finer(one, method, n, solution);
    std::vector<Entry> entries;
    const auto enter = [&](const std::string &way, const std::string &norm, double error,
                           double estimate, const study::ErrorEstimate &details)
    {
      if (error > round_off * size || error > estimate)
        entries.push_back({one.name + way, method.name(), norm, problem.h, error, estimate, size,
                           details.certified_digits, details});
    };
    for (const bool is_cheap : {false, true})
      if (!is_cheap || problem.mesh())
      {
        const auto found = study::estimate_error(one, method, solution, is_cheap);
        const std::string way = is_cheap ? ", by 2 h" : "";
        enter(way, "averages", truth.averages, found.estimate, found);
        enter(way, "field", truth.field, found.field_estimate, found);
      }
    return entries;
  }

  double median_ratio(const std::vector<Entry> &entries)
  {
    std::vector<double> ratios;
    for (const Entry &entry : entries)
      ratios.push_back(entry.ratio());
    if (ratios.empty())
      return 0;
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::nth_element(ratios.begin(), middle, ratios.end());
    return *middle;
  }
} // namespace plumbline::audit
