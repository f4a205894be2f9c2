#pragma once

#include "scene/scene.h"

#include <optional>
#include <string>

namespace plumbline::scene
{
  class Keys;

  /// A key without effect.
  struct UnusedKey
  {
    std::string key;  ///< "Section/key"
    std::string text; ///< message with its value and the settings that it needs
  };

  /// The first key with a value other than its default that has no effect: nothing uses it, or the
  /// key that enables its section is not given.
  /// @param keys  the given keys, bound to the members of the scene
  std::optional<UnusedKey> find_unused_key(const Keys &keys, const Scene &scene);
} // namespace plumbline::scene
