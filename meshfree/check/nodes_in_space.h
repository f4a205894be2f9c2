#pragma once

#include "geometry/cube_lattice.h"
#include "meshfree/check/bond_file.h"

// The counterpart of bond_file.h for nodes of one box in three dimensions.
namespace plumbline::meshfree
{
  /// Cube root of the volume of Ω over the number of its nodes [length].
  /// @throws InputError  no node lies in Ω
  double node_spacing(const GivenNodes<3> &nodes, const geometry::Cuboid &omega);

  /// Nodes of other codes in space, with their cells.
  struct CellsInSpace
  {
    /// Nodes strictly inside Ω are free, in a periodic box all but the images. No pieces if
    /// the nodes form a lattice, or do not fill Ω and its interaction domain: all volumes
    /// are then those of a cube whose side is the spacing.
    geometry::NodeCells<3> cells;
    double lattice = 0; ///< spacing of the lattice of cubes; 0: scattered nodes [length]
  };

  /// Lattices are recognised to 1e-4 of the spacing; other nodes have Voronoi cells (see
  /// geometry::voronoi_cells).
  /// @throws InputError  no node in Ω
  CellsInSpace given_cells(const GivenNodes<3> &nodes, const geometry::Cuboid &omega,
                           double horizon);
} // namespace plumbline::meshfree
