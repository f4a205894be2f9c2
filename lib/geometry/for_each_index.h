#pragma once

#include <array>

namespace plumbline::geometry
{
  /// visit(i) for all i with from[d] <= i[d] < to[d], the first index fastest.
  template <class Visit>
  void for_each_index(const std::array<int, 3> &from, const std::array<int, 3> &to,
                      const Visit &visit)
  {
    for (int k = from[2]; k < to[2]; ++k)
      for (int j = from[1]; j < to[1]; ++j)
        for (int i = from[0]; i < to[0]; ++i)
          visit(std::array<int, 3>{i, j, k});
  }
} // namespace plumbline::geometry
