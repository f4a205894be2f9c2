#pragma once

#include "method/method.h"

namespace plumbline::meshfree
{
  /// Every rule of the table as a method, on lattices and on scattered nodes.
  method::Methods methods();
} // namespace plumbline::meshfree
