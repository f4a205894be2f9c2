#include "scene/mesh_files.h"

#include "base/text_file.h"

namespace plumbline::scene
{
  const geometry::Mesh &MeshFiles::read(const std::string &file, double h, double delta,
                                        bool has_collar, bool is_curved)
  {
    if (base::has_ending(file, ".msh"))
      h = delta = 1; // any: its cells do not depend on them
    const auto key = std::make_tuple(file, h, delta, has_collar, is_curved);
    const auto known = meshes_.find(key);
    if (known != meshes_.end())
      return known->second;
    return meshes_.emplace(key, geometry::read_mesh(file, h, delta, has_collar, is_curved))
        .first->second;
  }

  const std::shared_ptr<const geometry::TetrahedralMesh> &
  MeshFiles::read_in_space(const std::string &file, double h, double delta)
  {
    if (base::has_ending(file, ".msh"))
      h = delta = 1;
    const auto key = std::make_tuple(file, h, delta);
    const auto known = meshes_in_space_.find(key);
    if (known != meshes_in_space_.end())
      return known->second;
    return meshes_in_space_
        .emplace(key, std::make_shared<const geometry::TetrahedralMesh>(
                          geometry::read_tetrahedra(file, h, delta)))
        .first->second;
  }
} // namespace plumbline::scene
