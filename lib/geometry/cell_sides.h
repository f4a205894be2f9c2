#pragma once

#include "geometry/node_cells.h"

namespace plumbline::geometry
{
  /// What the cells of two nodes have in common.
  struct CellSide
  {
    std::array<unsigned int, 2> nodes; ///< ascending
    std::array<Point<2>, 2> ends;      ///< [length]
  };

  /// The sides that Voronoi cells share, ordered by their nodes. A side that a hole of the body
  /// interrupts is taken as one; sides shorter than 1e-6 of a cell's size are left out.
  std::vector<CellSide> shared_sides(const NodeCells<2> &cells);
} // namespace plumbline::geometry
