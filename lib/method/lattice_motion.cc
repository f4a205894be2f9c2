#include "method/lattice_motion.h"

#include "algebra/sparse.h"
#include "method/lattice_discretisation.h"
#include "method/linear_motion.h"

#include <deal.II/lac/vector.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace plumbline::method
{
  namespace
  {
    bool is_diagonal(const algebra::Stencil &stencil)
    {
      return stencil.n_entries() == stencil.n_blocks();
    }

    /// @param positions  of the unknowns; those of a matrix are numbered node by node
    MassRoot mass_root(const algebra::Stencil &mass, const geometry::NodeSet &nodes,
                       const std::vector<std::size_t> &positions)
    {
      if (!is_diagonal(mass))
        return MassRoot(algebra::assemble(mass, nodes));
      std::vector<double> masses;
      for (const std::size_t position : positions)
      {
        const auto s = static_cast<unsigned int>(position / nodes.n_positions());
        masses.push_back(mass(s, s, 0, 0));
      }
      return MassRoot(masses);
    }

    /// What the collar adds to a stencil's action.
    algebra::Vector around(const algebra::Stencil &stencil, const geometry::NodeSet &nodes,
                           const problem::Problem<2> &instant)
    {
      return collar_action(stencil, nodes, collar_values(instant, nodes, stencil.reach()));
    }
  } // namespace

  std::unique_ptr<EquationOfMotion> move_on_lattice(LatticeParts given)
  {
    const auto parts = std::make_shared<const LatticeParts>(std::move(given));
    auto positions = algebra::free_positions(parts->nodes);
    std::vector<std::size_t> place;
    if (is_diagonal(parts->mass)) // component by component, as sums go
    {
      std::vector<std::size_t> sorted = positions;
      std::sort(sorted.begin(), sorted.end());
      for (const std::size_t position : positions)
        place.push_back(static_cast<std::size_t>(
            std::lower_bound(sorted.begin(), sorted.end(), position) - sorted.begin()));
      positions = sorted;
    }
    const auto unknowns = [positions](const algebra::Vector &over_nodes)
    {
      std::vector<double> u;
      u.reserve(positions.size());
      for (const std::size_t position : positions)
        u.push_back(over_nodes[position]);
      return u;
    };
    const auto load = [parts, unknowns](const problem::Problem<2> &instant)
    {
      algebra::Vector load = parts->load(instant);
      load -= around(parts->stiffness, parts->nodes, instant);
      return unknowns(load);
    };
    const auto inertia = [parts, unknowns](const problem::Problem<2> &instant)
    {
      problem::Problem<2> of_solution = instant;
      of_solution.load = *instant.solution;
      algebra::Vector load = parts->load(of_solution);
      load -= around(parts->mass, parts->nodes, instant);
      return unknowns(load);
    };
    return move_linear<2>(
        {free_points(parts->lattice, parts->nodes),
         parts->nodes.n_components,
         place,
         mass_root(parts->mass, parts->nodes, positions),
         algebra::restrict(algebra::make_operator(parts->stiffness, parts->nodes, parts->backend),
                           parts->nodes.size(), positions),
         {},
         load,
         inertia,
         parts->cell});
  }

  std::vector<double> collar_values(const problem::Problem<2> &problem,
                                    const geometry::NodeSet &nodes, int margin,
                                    std::vector<std::size_t> *constrained)
  {
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(nodes.n_blocks()) * (nodes.n[0] + 2 * margin) *
                   (nodes.n[1] + 2 * margin));
    for (unsigned int c = 0; c < nodes.n_components; ++c)
      for (unsigned int s = 0; s < nodes.n_families(); ++s)
        for (int j = -margin; j < nodes.n[1] + margin; ++j)
          for (int i = -margin; i < nodes.n[0] + margin; ++i)
          {
            double value = 0;
            if (!nodes.free(s, i, j))
            {
              const auto place = nodes.place(s, i, j);
              value = problem.constraint.value(problem.lattice()->point(place[0], place[1]), c);
              if (constrained != nullptr)
                constrained->push_back(values.size());
            }
            values.push_back(value);
          }
    return values;
  }
} // namespace plumbline::method
