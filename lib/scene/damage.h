#pragma once

#include "geometry/node_cells.h"
#include "scene/scene.h"

namespace plumbline::scene
{
  /// Of each node whether it lies beyond a free surface; empty where the scene has none.
  std::vector<char> find_ghosts(const Scene &scene, double horizon,
                                const geometry::NodeCells &cells);

  /// Cracks and free surfaces can be used with the nodes of a level.
  /// @throws InputError  as geometry::check_cracks and check_ghosts, naming the key
  void check_damage(const Scene &scene, double horizon, const geometry::NodeCells &cells);
} // namespace plumbline::scene
