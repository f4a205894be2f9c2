#pragma once

#include "problem/in_space.h"
#include "scene/scene.h"

#include <memory>
#include <optional>

namespace plumbline::scene
{
  /// The tetrahedra of a scene's mesh file at a level, checked; their layer around Ω holds the
  /// ball, if the surface is not free.
  /// @pre scene.domain.is_in_space() and scene.domain.mesh.is_file()
  /// @throws InputError  a mesh that cannot be used, or an interaction domain thinner than the
  /// horizon
  std::shared_ptr<const geometry::TetrahedralMesh> make_mesh_in_space(const Scene &scene,
                                                                      const Level &level);

  /// Kernel/materials, if they are given.
  /// @throws InputError  a group of the mesh without a material, a material without a group, a
  /// coefficient that is not positive
  std::optional<problem::GroupFactors> make_factors(const Scene &scene,
                                                    const geometry::TetrahedralMesh &mesh);
} // namespace plumbline::scene
