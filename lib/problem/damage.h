#pragma once

#include "geometry/node_cells.h"
#include "problem/problem.h"

namespace plumbline::problem
{
  /// Positive beyond free surfaces; empty where there are none. Copies share nothing: give each
  /// thread its own.
  std::function<double(const dealii::Point<2> &)> outside(const Damage<2> &damage, double horizon);

  /// Of each node whether it lies beyond a free surface; empty where there is none.
  std::vector<char> find_ghosts(const Damage<2> &damage, double horizon,
                                const geometry::NodeCells &cells);
} // namespace plumbline::problem
