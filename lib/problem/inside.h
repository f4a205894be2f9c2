#pragma once

#include "problem/problem.h"

#include <functional>

namespace plumbline::problem
{
  /// Whether points lie in Ω, which is closed, in the problem's coordinates. Thread safe.
  /// @param problem  must outlive what is returned
  std::function<bool(const dealii::Point<2> &)> inside(const Problem<2> &problem);
} // namespace plumbline::problem
