#pragma once

#include "geometry/node_cells.h"
#include "problem/damage.h"
#include "scene/scene.h"

namespace plumbline::scene
{
  /// The scene's cracks and free surfaces.
  problem::Damage<2> make_damage(const Scene &scene, double horizon);

  /// Cracks and free surfaces can be used with the nodes of a level.
  /// @throws InputError  as geometry::check_cracks and check_ghosts, naming the key
  void check_damage(const Scene &scene, double horizon, const geometry::NodeCells<2> &cells);
} // namespace plumbline::scene
