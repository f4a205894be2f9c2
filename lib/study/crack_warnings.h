#pragma once

#include "method/method.h"
#include "scene/problem.h"

#include <string>
#include <vector>

namespace plumbline::study
{
  /// Of cracks that end on bonds, where any of the methods has bonds: see geometry::TipOnBonds.
  std::vector<std::string> tip_warnings(const scene::Problem &problem,
                                        const method::Methods &methods);
} // namespace plumbline::study
