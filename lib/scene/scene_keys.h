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

  /// A message that opens with a key ("Section/key ..."), as checks of a run give them, with the
  /// scene's file and the line that sets the key; others, and those of overridden keys, as they
  /// are.
  std::string with_place(const std::string &message, const std::string &file,
                         const std::vector<Override> &overrides);
} // namespace plumbline::scene
