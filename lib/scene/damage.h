#pragma once

#include "geometry/node_cells.h"
#include "scene/problem.h"

namespace plumbline::scene
{
  /// Positive beyond free surfaces; empty where there are none. Copies share nothing: give each
  /// thread its own.
  std::function<double(const dealii::Point<2> &)> outside(const Damage &damage, double horizon);

  /// Of each node whether it lies beyond a free surface; empty where there is none.
  std::vector<char> find_ghosts(const Damage &damage, double horizon,
                                const geometry::NodeCells &cells);

  /// Cracks and free surfaces can be used with the nodes of a level.
  /// @throws InputError  as geometry::check_cracks and check_ghosts, naming the key
  void check_damage(const Scene &scene, double horizon, const geometry::NodeCells &cells);
} // namespace plumbline::scene
