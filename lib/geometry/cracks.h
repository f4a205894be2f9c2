#pragma once

#include "geometry/node_cells.h"

namespace plumbline::geometry
{
  /// Two points or more; closed if it ends where it begins.
  using Polyline = std::vector<Point<2>>;

  /// A node is on a crack, and two points in one place, within this fraction of the horizon.
  constexpr double on_crack = 1e-9;

  /// It is known on which side of each crack the nodes are.
  /// @param is_ghost  of each node, empty: none; those need not be known
  /// @throws InputError  a node on a crack, naming it by the index it was given with; a crack
  /// without length
  void check_cracks(const std::vector<Polyline> &cracks, const NodeCells<2> &cells,
                    const std::vector<char> &is_ghost, double horizon);

  /// Ghosts, nodes beyond a free surface that only complete the balls of others, lie in the collar.
  /// @throws InputError  one in Ω, naming it
  void check_ghosts(const std::vector<char> &is_ghost, const NodeCells<2> &cells);
} // namespace plumbline::geometry
