#pragma once

#include "geometry/mesh_input.h"

#include <map>
#include <memory>
#include <string>
#include <tuple>

namespace plumbline::scene
{
  /// Cache of meshes read from files: cases, checks and estimates of a scene share the mesh of a
  /// level. Shared by copies of a scene; not thread-safe.
  class MeshFiles
  {
  public:
    /// As geometry::read_mesh; the file must not change meanwhile.
    const geometry::Mesh &read(const std::string &file, double h, double delta, bool has_collar,
                               bool is_curved);

    /// As geometry::read_tetrahedra, for scenes in space.
    const std::shared_ptr<const geometry::TetrahedralMesh> &read_in_space(const std::string &file,
                                                                          double h, double delta);

  private:
    std::map<std::tuple<std::string, double, double, bool, bool>, geometry::Mesh> meshes_;
    std::map<std::tuple<std::string, double, double>,
             std::shared_ptr<const geometry::TetrahedralMesh>>
        meshes_in_space_;
  };
} // namespace plumbline::scene
