#pragma once

#include "geometry/node_cells.h"
#include "meshfree/rules/bonds.h"

#include <functional>

namespace plumbline::meshfree
{
  /// What a rule sees of a node near the ball: enough to make a bond to it, on lattices and on
  /// scattered nodes alike.
  struct Candidate
  {
    geometry::Ball ball; ///< about the family's node
    Backend backend = Backend::fast;
    Point<2> xi;     ///< from the family's node to this one [length]
    double area = 0; ///< of this node's cell [length^2]
    dealii::ArrayView<const geometry::ConvexCell> pieces; ///< of this node's cell
  };

  /// The bonds of one node.
  struct Family
  {
    std::vector<unsigned int> neighbours; ///< indices of nodes, ascending; empty on a lattice
    std::vector<Bond> bonds;
    Fit fit;
    bool is_clipped = false; ///< a negative kernel beyond the horizon counted as 0
  };

  /// All that makes a rule.
  struct NeighbourhoodQuadrature
  {
    /// The bond to a candidate; weight 0: none.
    std::function<Bond(const Kernel<2> &, const Candidate &)> bond;
    /// Changes the weights of a whole family; empty: they stay.
    std::function<void(Family &)> adjust = {};
  };

  // Bonds that several rules start from.

  /// The cell's area if its node is in the ball, kernel at the node.
  Bond full_area_bond(const Kernel<2> &kernel, const Candidate &candidate);

  /// The area of ball ∩ cell, kernel at the node.
  Bond partial_area_bond(const Kernel<2> &kernel, const Candidate &candidate);

  /// The area of ball ∩ cell, kernel at its centroid.
  Bond centroid_bond(const Kernel<2> &kernel, const Candidate &candidate);

  /// 1 inside r = δ - √A/2, then linear through 1/2 at r = δ, negative beyond r = δ + √A/2.
  double ramp(const Kernel<2> &kernel, const Candidate &candidate);

  /// Add the bond to a candidate, if there is one.
  bool add_bond(const NeighbourhoodQuadrature &rule, const Kernel<2> &kernel,
                const Candidate &candidate, Family &family);

  /// Adjust the weights of a family that has all its bonds.
  /// @param where  of the node, for the message
  /// @throws NumericalError  no neighbours, or too few for the moments asked of them
  void finish(const NeighbourhoodQuadrature &rule, Family &family,
              const std::function<std::string()> &where);

  /// The family that all nodes of a lattice share.
  /// @throws NumericalError  as above
  Bonds lattice_bonds(const NeighbourhoodQuadrature &rule, const Kernel<2> &kernel, double h,
                      Backend backend);
} // namespace plumbline::meshfree
