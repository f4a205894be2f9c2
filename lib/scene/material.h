#pragma once

#include "scene/scene.h"

namespace plumbline::scene
{
  /// The solid that the keys of section Material describe.
  /// @param value  of a key
  /// @throws InputError  constants that do not fit together, or of no solid
  MaterialSection make_material(const std::function<std::string(const std::string &key)> &value);

  /// What the dilatation adds to a scene's bonds, or nothing.
  /// @throws InputError  (its material) a constant that is not allowed, naming key and place
  std::optional<physics::Dilatation> make_dilatation(const Scene &scene, double horizon);
} // namespace plumbline::scene
