#pragma once

#include "study/method.h"

namespace plumbline::meshfree
{
  /// Every rule of the table as a method, on lattices and on scattered nodes.
  study::Methods methods();
} // namespace plumbline::meshfree
