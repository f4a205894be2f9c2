#pragma once

#include "geometry/cell_counts.h"

namespace plumbline::geometry
{
  /// The largest boxes of cells in a set: each lies in it and in no larger one. They cover it and
  /// overlap.
  /// @param is_inside  shape (n[2], n[1], n[0])
  std::vector<CubeRange> maximal_boxes(const std::vector<char> &is_inside,
                                       const std::array<int, 3> &n);
} // namespace plumbline::geometry
