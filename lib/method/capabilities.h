#pragma once

#include "problem/capabilities.h"
#include "problem/problem.h"

namespace plumbline::method
{
  using problem::all_but;
  using problem::all_capabilities;
  using problem::Capabilities;
  using problem::Capability;

  /// What a problem needs since its mesh has cells of these kinds.
  Capabilities needs_of_cells(const problem::Problem<2> &problem);
} // namespace plumbline::method
