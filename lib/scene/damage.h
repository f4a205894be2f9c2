#pragma once

#include "geometry/node_cells.h"
#include "problem/damage.h"
#include "scene/scene.h"

namespace plumbline::scene
{
  /// Cracks and free surfaces can be used with the nodes of a level.
  /// @throws InputError  as geometry::check_cracks and check_ghosts, naming the key
  void check_damage(const Scene &scene, double horizon, const geometry::NodeCells &cells);
} // namespace plumbline::scene
