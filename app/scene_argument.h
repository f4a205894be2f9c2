#pragma once

#include "scene/scene.h"

#include <functional>
#include <string>
#include <vector>

namespace plumbline::app
{
  /// An action on a scene's file. What it throws names the file and the line of the key that the
  /// message opens with; where the file is not there, the scene that was probably meant.
  /// @return  what the action returns
  int with_scene(const std::string &file, const std::vector<scene::Override> &overrides,
                 const std::function<int()> &action);
} // namespace plumbline::app
