#pragma once

#include "scene/scene.h"

#include <optional>
#include <string>

namespace plumbline::scene
{
  class Keys;

  /// A key that is given in vain.
  struct UnusedKey
  {
    std::string key;  ///< "Section/key"
    std::string text; ///< its value and what it would need
  };

  /// The first key with another value than its default where nothing asks for it, or in a section
  /// whose first key, which turns it on, is not given.
  /// @param keys  those that were given, with the scene as their members
  std::optional<UnusedKey> find_unused_key(const Keys &keys, const Scene &scene);
} // namespace plumbline::scene
