#pragma once

#include "problem/in_space.h"

#include <functional>

namespace plumbline::problem
{
  /// Whether points lie in Ω, which is closed, in the problem's coordinates. Thread safe.
  /// @param problem  must outlive what is returned
  std::function<bool(const dealii::Point<2> &)> inside(const Problem<2> &problem);

  /// The same in space, of a lattice's cubes or a mesh's cells, to 1e-9 of their size.
  std::function<bool(const dealii::Point<3> &)> inside(const Problem<3> &problem);
} // namespace plumbline::problem
