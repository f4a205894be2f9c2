#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace plumbline::base
{
  /// Points of (0, 1) that approximations are held against, ascending: one in each of n equal
  /// parts, at a place that follows the golden ratio, so that no period of a field meets all of
  /// them. Neighbours are less than 1.8/n apart, and the ends less than .9/n from one: every
  /// interval of [0, 1] of that length holds a point. The same at every call.
  inline std::vector<double> control_points(std::size_t n)
  {
    constexpr double golden = .6180339887498949, margin = .1; // of a part, to keep off its ends
    std::vector<double> points(n);
    double turn = .5;
    for (std::size_t i = 0; i < n; ++i)
    {
      points[i] =
          (static_cast<double>(i) + margin + (1 - 2 * margin) * turn) / static_cast<double>(n);
      turn += golden;
      turn -= std::floor(turn);
    }
    return points;
  }
} // namespace plumbline::base
