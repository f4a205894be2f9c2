#pragma once

#include "scene/new_scene.h"

#include <string>

namespace plumbline::app
{
  /// Writes a scene with methods that the command that runs it accepts.
  /// @return  what was written, and the next command
  /// @throws InputError  as scene::write_new_scene; methods that the command refuses: nothing is
  /// left
  std::string write_scene(const scene::NewSceneOptions &options);
} // namespace plumbline::app
