#pragma once

#include "problem/capabilities.h"
#include "problem/problem.h"

namespace plumbline::problem
{
  /// What a problem needs since its mesh has cells of these kinds.
  Capabilities needs_of_cells(const Problem<2> &problem);

  /// All that a problem needs as far as it says so itself: not what is done with it.
  Capabilities needs(const Problem<2> &problem);
} // namespace plumbline::problem
