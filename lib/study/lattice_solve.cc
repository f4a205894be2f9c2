#include "study/lattice_solve.h"

#include "algebra/solve.h"
#include "algebra/sparse.h"
#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace plumbline::study
{
  namespace
  {
    /// The constraint at all positions within `margin` of the bounding box that are not free, less
    /// the middle of its range: the operator does not see a constant, but the solver's tolerance
    /// and rounding would.
    struct CollarData
    {
      std::vector<double> values; ///< 0 where nodes are free
      std::vector<double> middle; ///< of each component
    };

    CollarData collar_data(const scene::Problem &problem, const geometry::NodeSet &nodes,
                           int margin)
    {
      CollarData data;
      data.values.reserve(static_cast<std::size_t>(nodes.n_blocks()) * (nodes.n[0] + 2 * margin) *
                          (nodes.n[1] + 2 * margin));
      for (unsigned int c = 0; c < nodes.n_components; ++c)
      {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        std::vector<std::size_t> held;
        for (unsigned int s = 0; s < nodes.n_families(); ++s)
          for (int j = -margin; j < nodes.n[1] + margin; ++j)
            for (int i = -margin; i < nodes.n[0] + margin; ++i)
            {
              double value = 0;
              if (!nodes.free(s, i, j))
              {
                const auto place = nodes.place(s, i, j);
                value = problem.constraint.value(problem.lattice->point(place[0], place[1]), c);
                low = std::min(low, value);
                high = std::max(high, value);
                held.push_back(data.values.size());
              }
              data.values.push_back(value);
            }
        data.middle.push_back(held.empty() ? 0 : low + (high - low) / 2);
        for (const std::size_t place : held)
          data.values[place] -= data.middle.back();
      }
      return data;
    }

    /// Solution and data together on positions -1 ... n.
    std::vector<double> merge(const geometry::NodeSet &nodes, const algebra::Vector &solution,
                              const CollarData &data, int margin)
    {
      std::vector<double> values;
      const std::size_t width = nodes.n[0] + 2 * margin, height = nodes.n[1] + 2 * margin;
      values.reserve(static_cast<std::size_t>(nodes.n_blocks()) * (nodes.n[0] + 2) *
                     (nodes.n[1] + 2));
      for (std::size_t s = 0; s < nodes.n_blocks(); ++s)
        for (int j = -1; j <= nodes.n[1]; ++j)
          for (int i = -1; i <= nodes.n[0]; ++i)
          {
            double value = data.values[(s * height + j + margin) * width + i + margin];
            if (i >= 0 && j >= 0 && i < nodes.n[0] && j < nodes.n[1])
              value += solution[(s * nodes.n[1] + j) * nodes.n[0] + i];
            values.push_back(value + data.middle[s / nodes.n_families()]);
          }
      return values;
    }
  } // namespace

  LatticeSolve solve_on_lattice(const scene::Scene &scene, const scene::Problem &problem,
                                const geometry::NodeSet &nodes, const algebra::Stencil &stencil,
                                const std::function<algebra::Vector()> &load)
  {
    if (const double defect = stencil.symmetry_defect(); defect > 1e-12)
    {
      std::ostringstream message;
      message << "the operator is not symmetric (defect " << defect
              << "), so conjugate gradients would give a wrong solution";
      throw NumericalError(message.str());
    }
    LatticeSolve result;
    base::CpuTimer timer;
    const auto matrix = make_operator(stencil, nodes, scene.solver.operator_backend);
    const algebra::SchwarzPreconditioner preconditioner(stencil, nodes,
                                                        maximal_rectangles(*problem.lattice));
    result.cost.setup_seconds = timer.seconds();

    timer.restart();
    const int margin = stencil.reach();
    const auto data = collar_data(problem, nodes, margin);
    algebra::Vector right_hand_side = load();
    right_hand_side -= collar_action(stencil, nodes, data.values);
    algebra::Vector solution(nodes.size());
    const auto solved = algebra::solve(*matrix, preconditioner, solution, right_hand_side,
                                       scene.solver.tolerance, scene.solver.max_iterations);
    result.values = merge(nodes, solution, data, margin);
    result.cost.solve_seconds = timer.seconds();
    result.cost.n_unknowns = nodes.n_unknowns();
    result.cost.n_bonds = matrix->n_bonds();
    result.cost.n_iterations = solved.n_iterations;
    result.diagnostics.n_neighbours =
        static_cast<unsigned int>(stencil.n_entries() / stencil.n_blocks() - 1);
    result.diagnostics.relative_residual = solved.relative_residual;
    result.diagnostics.operator_backend = matrix->backend();
    return result;
  }

  double expected_lattice_bytes(const ProblemSize &size, unsigned int n_families,
                                unsigned int n_components, double reach)
  {
    const double n_blocks = n_families * n_components, value = sizeof(double), bond = 48;
    // solution, data, five vectors of conjugate gradients, a sine solver or one of reflections
    const double of_unknown = n_families == 1 ? 9 * value : 38 * value;
    // a field, its modes, and half of the symbol's blocks
    const double of_mode = value * n_blocks * (2 + (n_blocks + 1) / 2);
    const double n = size.extents[0] * size.extents[1];
    const double n_padded = (size.extents[0] + 2 * reach) * (size.extents[1] + 2 * reach);
    return n * n_blocks * of_unknown + n_padded * of_mode +
           std::pow((2 * reach + 1) * n_blocks, 2) * value + 3.2 * reach * reach * bond;
  }

  DiscreteOperator show_on_lattice(const geometry::Lattice &lattice, const geometry::NodeSet &nodes,
                                   const algebra::Stencil &stencil, const std::vector<double> &mass)
  {
    constexpr std::size_t most_entries = 20000000;
    DiscreteOperator result;
    result.n_components = nodes.n_components;
    for (unsigned int s = 0; s < nodes.n_families(); ++s)
      for (int j = 0; j < nodes.n[1]; ++j)
        for (int i = 0; i < nodes.n[0]; ++i)
          if (nodes.free(s, i, j))
          {
            const auto place = nodes.place(s, i, j);
            result.nodes.push_back(lattice.point(place[0], place[1]));
            result.mass.push_back(mass[s]);
          }
    if (stencil.n_entries() / stencil.n_blocks() * nodes.n_unknowns() <= most_entries)
      result.rows = algebra::assemble(stencil, nodes);
    for (int k2 = -stencil.reach(); k2 <= stencil.reach() && stencil.n_blocks() == 1; ++k2)
      for (int k1 = -stencil.reach(); k1 <= stencil.reach(); ++k1)
        result.second_moment -= stencil(0, 0, k1, k2) * std::pow(k1 * lattice.h(), 2) / mass[0];
    result.reach = stencil.n_blocks() == 1 ? stencil.reach() * lattice.h() : 0;
    result.action = algebra::restrict(make_operator(stencil, nodes), nodes.size(),
                                      algebra::free_positions(nodes));
    return result;
  }
} // namespace plumbline::study
