#pragma once

#include "geometry/cell_counts.h"

namespace plumbline::geometry
{
  /// The maximal boxes of a set of cells: each lies in the set and in no larger box that does.
  /// Together they cover the set; they may overlap.
  /// @param is_inside  shape (n[2], n[1], n[0])
  std::vector<CubeRange> maximal_boxes(const std::vector<char> &is_inside,
                                       const std::array<int, 3> &n);
} // namespace plumbline::geometry
