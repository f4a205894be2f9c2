#pragma once

#include "scene/scene.h"

namespace plumbline::scene
{
  class Keys;

  /// That no key is given in vain: with another value than its default where nothing asks for it,
  /// or in a section whose first key, which turns it on, is not given.
  /// @param keys   those that were given, with the scene as their members
  /// @throws InputError  naming the key, its value, and what it would need
  void check_unused_keys(const Keys &keys, const Scene &scene);
} // namespace plumbline::scene
