#pragma once

#include "scene/capabilities.h"
#include "scene/problem.h"

namespace plumbline::method
{
  using scene::all_but;
  using scene::all_capabilities;
  using scene::Capabilities;
  using scene::Capability;

  /// What a scene needs, with the cells that its problem has.
  /// @param one  of any case and level
  Capabilities needs(const scene::Case &one);
} // namespace plumbline::method
