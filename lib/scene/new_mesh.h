#pragma once

#include <string>

namespace plumbline::scene
{
  /// What a new scene takes from a mesh file.
  struct NewMesh
  {
    unsigned int dimension = 2;
    bool is_quadrilaterals = false;
    std::string h, m;  ///< values of Study/h and Study/m, which the mesh and its collar allow
    std::string found; ///< cells, physical groups and sizes, for the user
  };

  /// Reads a .geo or .msh file, meshed once with the values that DefineConstant gives h and delta
  /// if it is a script that has them: then the scene has four levels, in space two. Other meshes do
  /// not depend on h, and have one level only.
  /// @throws InputError  no such file, another ending, a mesh that cannot be used, with what it
  /// lacks
  NewMesh look_at_mesh(const std::string &file);
} // namespace plumbline::scene
