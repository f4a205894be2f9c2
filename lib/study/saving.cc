#include "study/saving.h"

#include "base/error.h"
#include "study/refusal.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumbline::study
{
  namespace
  {
    /// Nodes row by row, whatever their order was.
    std::vector<std::size_t> sorted(const std::vector<dealii::Point<2>> &nodes, double h)
    {
      constexpr double rounding = 1e-6;
      std::vector<std::size_t> order(nodes.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::sort(order.begin(), order.end(),
                [&](std::size_t i, std::size_t j)
                {
                  const dealii::Point<2> &a = nodes[i], &b = nodes[j];
                  return std::abs(a[1] - b[1]) > rounding * h ? a[1] < b[1] : a[0] < b[0];
                });
      return order;
    }

    /// Largest difference of nodal values, relative to the largest value.
    double difference(const Solution &a, const Solution &b, double h)
    {
      if (a.nodes.size() != b.nodes.size() || a.nodal.size() != b.nodal.size())
        throw NumericalError("the full model has other nodes than the smallest one");
      const auto order_a = sorted(a.nodes, h), order_b = sorted(b.nodes, h);
      const std::size_t n_components = a.nodal.size() / a.nodes.size();
      double worst = 0, largest = 0;
      for (std::size_t i = 0; i < order_a.size(); ++i)
        for (std::size_t c = 0; c < n_components; ++c)
        {
          const double value = a.nodal[n_components * order_a[i] + c];
          worst = std::max(worst, std::abs(value - b.nodal[n_components * order_b[i] + c]));
          largest = std::max(largest, std::abs(value));
        }
      return largest > 0 ? worst / largest : worst;
    }
  } // namespace

  std::optional<Saving> measure_saving(const scene::Case &one, const Method &method,
                                       const Solution &solution)
  {
    if (!one.full_model)
      return {};
    const problem::Problem<2> full = one.full_model();
    if (!can_solve(method, full))
      return {};
    try
    {
      // ranks do not share lattices, and may be at different methods
      const auto ranks =
          one.problem.lattice() ? base::Communicator::alone() : base::Communicator::all();
      const Solution whole = analysis::solve(method, full, ranks);
      return Saving{method.name(), full.h,     full.horizon(),
                    solution.cost, whole.cost, difference(solution, whole, full.h)};
    }
    catch (const NumericalError &)
    {
      return {};
    }
  }
} // namespace plumbline::study
