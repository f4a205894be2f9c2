#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace plumbline::scene
{
  /// Called before a scene is read as a whole: names all keys at once that an analysis requires
  /// and that neither the file nor the overrides give, and how to get a scene that has them.
  /// Invalid values are left to read_scene(). Scenes that are pipes cannot be read twice
  /// and are not checked.
  /// @param analysis  of driver::analyses()
  /// @throws InputError  keys are missing
  void require_keys(const std::string &analysis, const std::string &file,
                    const std::vector<Override> &overrides);
} // namespace plumbline::scene
