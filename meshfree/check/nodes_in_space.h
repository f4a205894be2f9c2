#pragma once

#include "geometry/cube_lattice.h"
#include "meshfree/check/bond_file.h"

// What bond_file.h has of nodes in the plane, for one box in space.
namespace plumbline::meshfree
{
  /// Cube root of the volume of Ω over the number of its nodes [length].
  /// @throws InputError  no node lies in Ω
  double node_spacing(const GivenNodes<3> &nodes, const geometry::Cuboid &omega);

  /// Nodes of other codes in space, with their cells.
  struct CellsInSpace
  {
    /// Nodes strictly inside Ω are free, in a periodic box all but the images. Without pieces where
    /// the nodes are those of a lattice, or do not fill Ω and its interaction domain: all volumes
    /// are those of a cube of the nodes' spacing then.
    geometry::NodeCells<3> cells;
    double lattice = 0; ///< spacing of the lattice of cubes; 0: scattered nodes [length]
  };

  /// Lattices are told by their nodes, to 1e-4 of the spacing; other nodes have Voronoi cells (see
  /// geometry::voronoi_cells).
  /// @throws InputError  no node in Ω
  CellsInSpace given_cells(const GivenNodes<3> &nodes, const geometry::Cuboid &omega,
                           double horizon);
} // namespace plumbline::meshfree
