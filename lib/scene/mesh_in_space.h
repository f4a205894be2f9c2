#pragma once

#include "geometry/tetrahedral_mesh.h"
#include "scene/scene.h"

#include <memory>

namespace plumbline::scene
{
  /// The tetrahedra of a scene's mesh file at a level, checked; their layer around Ω holds the
  /// ball.
  /// @pre scene.domain.is_in_space() and scene.domain.mesh.is_file()
  /// @throws InputError  a mesh that cannot be used, or an interaction domain thinner than the
  /// horizon
  std::shared_ptr<const geometry::TetrahedralMesh> make_mesh_in_space(const Scene &scene,
                                                                      const Level &level);
} // namespace plumbline::scene
