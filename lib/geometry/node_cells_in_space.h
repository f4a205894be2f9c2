#pragma once

#include "geometry/cube_lattice.h"
#include "geometry/node_cells.h"

namespace plumbline::geometry
{
  /// Voronoi cells of the nodes of Ω clipped to Ω, and of the nodes around it clipped to the layer
  /// of so many cubes around its bounding box, so that the cells tile both: the volumes add up to
  /// those of Ω and the layer to 1e-12. A cell that no boundary cuts is one piece; else its pieces
  /// are its overlaps with boxes. A node on the boundary of Ω lies in Ω.
  /// Cost: some 60 µs and 6 kB a node.
  /// @throws InputError  two nodes in one place (see find_coincident_nodes), a node outside Ω and
  /// the layer, a coordinate that is not finite, naming the node by its index; no node in Ω, or
  /// none in the layer
  NodeCells<3> voronoi_cells(const std::vector<dealii::Point<3>> &nodes, const CubeLattice &omega,
                             int n_layers);

  /// So many layers of cubes hold all cells that a ball can meet: one more than the ball needs, as
  /// some rules see half a cell beyond it.
  int layers_for(double horizon, double h);

  /// The same, or more, so that the layer holds all nodes.
  /// @throws InputError  on a side of Ω's bounding box nodes end nearer than horizon - h
  int layers_around(const std::vector<dealii::Point<3>> &nodes, const CubeLattice &omega,
                    double horizon);

  /// Centres of the cubes of Ω and of so many layers around its bounding box, x fastest; each moved
  /// by up to perturbation h along each axis, uniformly, with a seed, the same on every machine.
  /// @pre 0 <= perturbation < 1/2: each stays in its cube
  std::vector<dealii::Point<3>> lattice_nodes(const CubeLattice &omega, int n_layers,
                                              double perturbation, unsigned int seed);
} // namespace plumbline::geometry
