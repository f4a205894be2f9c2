#pragma once

#include "study/method.h"

namespace plumbline::meshfree
{
  /// Every rule of the table as a method on the scene's lattice.
  study::Methods lattice_methods();
} // namespace plumbline::meshfree
