#pragma once

#include "scene/scene.h"

namespace plumbline::scene
{
  /// Let all places that a scene's keys name count from DomainSection::origin, which is found
  /// first: of boxes and of .msh files by their own places, of deal.II's generators by their
  /// coarsest mesh, of a map by where it takes the boxes' corners.
  /// @pre its keys are read, and nothing has followed from them
  void move_to_domain(Scene &scene);

  /// A message with places in it, and where these count from, if that is not (0, 0). Expressions
  /// name places in the scene's coordinates, as "(x, y) = (1, 2)".
  std::string with_origin(const std::string &message, const dealii::Point<2> &origin);
} // namespace plumbline::scene
