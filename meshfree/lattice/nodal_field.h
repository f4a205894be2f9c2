#pragma once

#include "geometry/lattice.h"

#include <string>
#include <vector>

namespace plumbline::meshfree
{
  /// Nodal values as the piecewise constant function K_κ u on the squares around the nodes, the
  /// constraint on those outside.
  struct NodalField
  {
    geometry::Lattice lattice;
    geometry::NodeSet nodes;    ///< one family
    std::vector<double> values; ///< shape (n_components, n[1] + 2, n[0] + 2), positions -1 ... n

    /// The value at node (i, j), -1 <= i <= n[0].
    double at(unsigned int component, int i, int j) const;

    double value(const geometry::Point<2> &x, unsigned int component) const;

    /// The free nodes as points with u as point data.
    void write_vtu(const std::string &file) const;
  };
} // namespace plumbline::meshfree
