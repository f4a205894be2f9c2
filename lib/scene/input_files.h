#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace plumbline::scene
{
  /// The files that a scene names, from its folder: its mesh with what a .geo script reads, the
  /// table of its kernel, the nodes of each level, the pictures of its random field. Those that are
  /// not there are left out.
  std::vector<std::string> named_files(const Scene &scene);

  /// A comment of scene files, with a line for each of these and a hash of what is in it (FNV-1a,
  /// 64 bits); empty without such files. Results whose scene says the same of them are its own.
  std::string describe_files(const Scene &scene);
} // namespace plumbline::scene
