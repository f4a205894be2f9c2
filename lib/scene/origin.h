#pragma once

#include "scene/scene.h"

namespace plumbline::scene
{
  /// Determines DomainSection::origin and makes all coordinates in a scene's keys relative to it.
  /// The origin is found from boxes and .msh files themselves, from the coarsest mesh of deal.II
  /// generators, and from the mapped corners of boxes.
  /// @pre all keys are read, and no derived values are computed yet
  void move_to_domain(Scene &scene);

  /// A message with coordinates, completed by the origin if that is not (0, 0). Messages of
  /// expressions already use the scene's coordinates, as "(x, y) = (1, 2)".
  std::string with_origin(const std::string &message, const dealii::Point<2> &origin);
} // namespace plumbline::scene
