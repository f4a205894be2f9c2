#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace plumbline::scene
{
  /// Existing files that a scene names, relative to its folder: its mesh and the files that a .geo
  /// script includes, the table of its kernel, the nodes of each level, the files of its random
  /// field.
  std::vector<std::string> named_files(const Scene &scene);

  /// A comment for scene text with one line for each of these files and a hash of its content
  /// (FNV-1a, 64 bits); empty without such files. Equal hashes show that results belong to the
  /// scene.
  std::string describe_files(const Scene &scene);
} // namespace plumbline::scene
