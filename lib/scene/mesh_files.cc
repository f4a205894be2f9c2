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
} // namespace plumbline::scene
