#pragma once

#include "meshfree/rules/quadrature_rule.h"

namespace plumbline::meshfree
{
  /// The families of a rule on nodes of a lattice of squares or cubes: one family for all, less
  /// the bonds to places without a node.
  template <int dim>
  class LatticeFamilies
  {
  public:
    /// @param cells  of nodes on a lattice; must outlive the families
    /// @param h      its spacing [length]
    /// @throws NumericalError  the rule has no weights on it
    LatticeFamilies(const NeighbourhoodQuadrature<dim> &rule, const Kernel<dim> &kernel,
                    const geometry::NodeCells<dim> &cells, double h);

    Family<dim> family(std::size_t node) const;

  private:
    using Place = std::array<int, dim>;

    Place place(const Point<dim> &x) const;
    /// The index of the node at a place; n_nodes: there is none.
    std::size_t node_at(const Place &at) const;

    const geometry::NodeCells<dim> &cells_;
    double h_;
    Point<dim> lower_;
    Place n_{};                      ///< places along each axis
    std::vector<unsigned int> node_; ///< in each place, x fastest
    std::vector<Bond<dim>> bonds_;   ///< of a node
  };
} // namespace plumbline::meshfree
