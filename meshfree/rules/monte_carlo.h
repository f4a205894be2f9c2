#pragma once

#include "meshfree/rules/quadrature_rule.h"

namespace plumbline::meshfree
{
  /// Monte Carlo integration with the nodes as samples: each of the n nodes in the ball, the
  /// family's own included, has the same part |B|/n of the ball; kernel at the node. On lattices it
  /// is FA times the ball's area over that of n cells.
  template <int dim>
  NeighbourhoodQuadrature<dim> monte_carlo(const Kernel<dim> &kernel);
} // namespace plumbline::meshfree
