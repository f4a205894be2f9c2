#include "meshfree/check/precision.h"

#include <algorithm>

namespace plumbline::meshfree
{
  Precision Precision::of_files(double length, double weight, double volume, double size,
                                double horizon)
  {
    Precision result;
    result.length = length;
    // a side of a cell, or the cut of a ball, may move by the rounding of two nodes at both ends
    const double of_area = 8 * length / size;
    result.volume = std::max(result.volume, volume + of_area);
    result.weight = std::max(result.weight, 2 * weight + volume + of_area);
    // Σ w C ξ²: relative changes of w count as they are, those of ξ and of the kernel's argument
    // at most six times, at bonds of half the horizon
    result.moments = std::max(result.moments, 2 * weight + 12 * length / horizon);
    return result;
  }
} // namespace plumbline::meshfree
