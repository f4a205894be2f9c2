#pragma once

#include "scene/scene.h"

namespace plumbline::scene
{
  /// Value of one key in the overrides or, if they do not give it, in a scene file, without checks
  /// of the other keys.
  /// @param key  "Section/key", its name today
  /// @return     empty: not given, or the file is a pipe, which can be read only once
  /// @throws InputError  the file cannot be read, as read_scene
  std::string value_of_key(const std::string &file, const std::vector<Override> &overrides,
                           const std::string &key);
} // namespace plumbline::scene
