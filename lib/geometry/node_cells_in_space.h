#pragma once

#include "geometry/cube_lattice.h"
#include "geometry/node_cells.h"

namespace plumbline::geometry
{
  /// Voronoi cells of the nodes of Ω clipped to Ω, and of the nodes around it clipped to a layer
  /// around Ω's bounding box, which ends half a spacing beyond the last node on each side: the
  /// cells tile both, to 1e-12. The spacing is that of the nodes of Ω, ∛(volume / nodes). A cell
  /// that no boundary cuts is one piece; else its pieces are its overlaps with boxes. A node on the
  /// boundary of Ω lies in Ω. Nodes beyond the horizon and two spacings more are left out.
  /// Cost: some 60 µs and 6 kB a node.
  /// @throws InputError  two nodes in one place, a coordinate that is not finite, naming the node
  /// by its index; no node in Ω; a spacing that is not of the size of h; nodes that do not fill the
  /// interaction domain: on a side of the bounding box they end nearer than the horizon less a
  /// spacing, or a place within the horizon of Ω is farther than 2.5 spacings from its nearest node
  NodeCells<3> voronoi_cells(const std::vector<dealii::Point<3>> &nodes, const CubeLattice &omega,
                             double horizon);

  /// So many layers of cubes hold all cells that a ball can meet: one more than the ball needs, as
  /// some rules see half a cell beyond it.
  int layers_for(double horizon, double h);

  /// Centres of the cubes of Ω and of so many layers around its bounding box, x fastest; each moved
  /// by up to perturbation h along each axis, uniformly, with a seed, the same on every machine.
  /// @pre 0 <= perturbation < 1/2: each stays in its cube
  std::vector<dealii::Point<3>> lattice_nodes(const CubeLattice &omega, int n_layers,
                                              double perturbation, unsigned int seed);
} // namespace plumbline::geometry
