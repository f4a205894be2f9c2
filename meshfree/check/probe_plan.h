#pragma once

#include <deal.II/base/point.h>

#include <cstddef>
#include <vector>

namespace plumbline::meshfree
{
  struct ProbeSettings
  {
    double horizon = 0;      ///< no force reaches farther [length]
    double step = 0;         ///< by which nodes are displaced along each axis [length]
    std::size_t n_nodes = 2; ///< to displace, those nearest to the middle of all
  };

  /// Which nodes are displaced, and which of them together.
  template <int dim>
  struct ProbePlan
  {
    std::vector<dealii::Point<dim>> places; ///< of all nodes [length]
    ProbeSettings settings;
    std::vector<std::size_t> displaced; ///< nodes, ascending
    /// Of each displaced node the nodes within the horizon but itself, ascending.
    std::vector<std::vector<std::size_t>> neighbours;
    /// Indices into `displaced`. No node lies within the horizon of two nodes of a group, so that
    /// its force is owed to one of them at most.
    std::vector<std::vector<std::size_t>> groups;

    /// How often forces are asked for: once without displacements, by central differences along
    /// each axis of each group, and of the first group with a second step.
    std::size_t n_runs() const { return 1 + 2 * dim * (groups.size() + 1); }
  };

  /// The nodes to displace are the settings' number of nodes nearest to the middle of the box about
  /// all nodes, in the maximum norm, and those as near as the last one: on a lattice a square or a
  /// cube. Groups are made first-fit: on a lattice their number does not depend on that of the
  /// nodes.
  /// @throws InputError  horizon, step or number of nodes not positive, a displaced node without
  /// neighbours
  template <int dim>
  ProbePlan<dim> plan_probe(const std::vector<dealii::Point<dim>> &places,
                            const ProbeSettings &settings);
} // namespace plumbline::meshfree
