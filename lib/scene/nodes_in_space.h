#pragma once

#include "geometry/node_cells_in_space.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace plumbline::scene
{
  /// From a file with columns x, y and z.
  /// @throws InputError  as base::Csv
  std::vector<dealii::Point<3>> read_nodes_in_space(const std::string &file);

  /// Scattered nodes of a level with their Voronoi cells.
  /// @throws InputError  a file that cannot be read, nodes that cannot be used, or that do not
  /// reach through the interaction domain; MemoryError
  geometry::NodeCells<3> make_cells_in_space(const Scene &scene, const Level &level,
                                             const geometry::CubeLattice &lattice);
} // namespace plumbline::scene
