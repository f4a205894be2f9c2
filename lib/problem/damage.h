#pragma once

#include "geometry/node_cells.h"
#include "problem/problem.h"

namespace plumbline::problem
{
  /// Of each node whether it lies beyond a free surface; empty where there is none.
  std::vector<char> find_ghosts(const Damage<2> &damage, const geometry::NodeCells<2> &cells);
} // namespace plumbline::problem
