#pragma once

#include "geometry/mesh_input.h"

#include <map>
#include <string>
#include <tuple>

namespace plumbline::scene
{
  /// Meshes of files, kept for whoever asks again: cases, checks and estimates of a scene share the
  /// mesh of a level. Belongs to a scene and its copies. Not for several threads at once.
  class MeshFiles
  {
  public:
    /// As geometry::read_mesh, of a file that does not change meanwhile.
    const geometry::Mesh &read(const std::string &file, double h, double delta, bool has_collar,
                               bool is_curved);

  private:
    std::map<std::tuple<std::string, double, double, bool, bool>, geometry::Mesh> meshes_;
  };
} // namespace plumbline::scene
