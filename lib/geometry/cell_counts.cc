#include "geometry/cell_counts.h"

#include <algorithm>

namespace plumbline::geometry
{
  CellCounts::CellCounts(const std::vector<char> &is_inside, const std::array<int, 3> &n)
      : n_(n), below_(index({0, 0, n[2] + 1}))
  {
    auto cell = is_inside.begin();
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
      {
        std::size_t in_row = 0;
        for (int i = 0; i < n[0]; ++i)
        {
          in_row += *cell++ != 0 ? 1 : 0;
          below_[index({i + 1, j + 1, k + 1})] = in_row + below_[index({i + 1, j, k + 1})] +
                                                 below_[index({i + 1, j + 1, k})] -
                                                 below_[index({i + 1, j, k})];
        }
      }
  }

  std::size_t CellCounts::in(const CubeRange &range) const
  {
    std::array<std::array<int, 2>, 3> ends{};
    for (unsigned int d = 0; d < 3; ++d)
      ends[d] = {std::clamp(range.lower[d], 0, n_[d]), std::clamp(range.upper[d], 0, n_[d])};
    std::size_t added = 0, subtracted = 0;
    for (unsigned int corner = 0; corner < 8; ++corner)
    {
      const unsigned int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
      ((x + y + z) % 2 == 1 ? added : subtracted) +=
          below_[index({ends[0][x], ends[1][y], ends[2][z]})];
    }
    return added - subtracted;
  }

  bool CellCounts::is_filled(const CubeRange &range) const
  {
    std::size_t volume = 1;
    for (unsigned int d = 0; d < 3; ++d)
      volume *= range.upper[d] - range.lower[d];
    return in(range) == volume;
  }
} // namespace plumbline::geometry
