#pragma once

#include "geometry/cube_lattice.h"

#include <algorithm>
#include <utility>

namespace plumbline::geometry
{
  /// The nodes in planes [first, second) of the third axis; planes beyond the box are left out.
  inline BoxNodes planes_of(const BoxNodes &nodes, const std::pair<int, int> &planes)
  {
    const auto within = [&nodes](int plane) { return std::clamp(plane, 0, nodes.n[2]); };
    const int first = within(planes.first), second = within(planes.second);
    BoxNodes result{{nodes.n[0], nodes.n[1], second - first}};
    if (!nodes.is_free.empty())
    {
      const auto start = [&nodes](int plane) {
        return nodes.is_free.begin() + static_cast<std::ptrdiff_t>(plane) * nodes.n[0] * nodes.n[1];
      };
      result.is_free.assign(start(first), start(second));
    }
    return result;
  }
} // namespace plumbline::geometry
