#pragma once

#include "scene/scene.h"

#include <functional>
#include <string>
#include <vector>

namespace plumbline::app
{
  /// Runs an action on a scene's file. Its errors name the file and the line of the key that the
  /// message begins with; if the file does not exist, the scene that was probably meant.
  /// @return  what the action returns
  int with_scene(const std::string &file, const std::vector<scene::Override> &overrides,
                 const std::function<int()> &action);
} // namespace plumbline::app
