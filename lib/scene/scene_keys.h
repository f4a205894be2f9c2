#pragma once

#include "scene/scene.h"

namespace plumbline::scene
{
  /// What a scene file or, before it, an override says of one key, without a look at the others.
  /// @param key  "Section/key"
  /// @return     empty: nothing is said, or the file is a pipe, which can be read only once
  /// @throws InputError  the file cannot be read, as read_scene
  std::string value_of_key(const std::string &file, const std::vector<Override> &overrides,
                           const std::string &key);
} // namespace plumbline::scene
