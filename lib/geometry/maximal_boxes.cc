#include "geometry/maximal_boxes.h"

#include "geometry/for_each_index.h"

namespace plumbline::geometry
{
  namespace
  {
    using Index = std::array<int, 3>;

    /// Along each axis: where the set changes, and the ends of the lattice. A largest box begins
    /// and ends there.
    std::array<std::vector<int>, 3> find_breaks(const std::vector<char> &is_inside, const Index &n)
    {
      std::array<std::vector<int>, 3> breaks;
      const std::array<std::size_t, 3> stride = {1, static_cast<std::size_t>(n[0]),
                                                 static_cast<std::size_t>(n[0]) * n[1]};
      for (unsigned int d = 0; d < 3; ++d)
      {
        std::vector<char> is_break(n[d] + 1, 0);
        is_break.front() = is_break.back() = 1;
        for (std::size_t cell = 0; cell < is_inside.size(); ++cell)
          if (const std::size_t at = cell / stride[d] % n[d];
              at > 0 && (is_inside[cell] != 0) != (is_inside[cell - stride[d]] != 0))
            is_break[at] = 1;
        for (int at = 0; at <= n[d]; ++at)
          if (is_break[at] != 0)
            breaks[d].push_back(at);
      }
      return breaks;
    }

    /// Of the blocks between breaks, all of whose cells are in the set or none.
    CellCounts count_blocks(const std::vector<char> &is_inside, const Index &n,
                            const std::array<std::vector<int>, 3> &breaks)
    {
      Index n_blocks{};
      for (unsigned int d = 0; d < 3; ++d)
        n_blocks[d] = static_cast<int>(breaks[d].size()) - 1;
      std::vector<char> is_block_inside;
      for_each_index(
          {0, 0, 0}, n_blocks,
          [&](const Index &at)
          {
            const Index cell = {breaks[0][at[0]], breaks[1][at[1]], breaks[2][at[2]]};
            is_block_inside.push_back(
                is_inside[cell[0] + static_cast<std::size_t>(n[0]) *
                                        (cell[1] + static_cast<std::size_t>(n[1]) * cell[2])]);
          });
      return {is_block_inside, n_blocks};
    }

    bool is_maximal(const CellCounts &blocks, const CubeRange &box)
    {
      for (unsigned int d = 0; d < 3; ++d)
      {
        CubeRange larger = box;
        --larger.lower[d];
        if (blocks.is_filled(larger))
          return false;
        larger = box;
        ++larger.upper[d];
        if (blocks.is_filled(larger))
          return false;
      }
      return true;
    }
  } // namespace

  std::vector<CubeRange> maximal_boxes(const std::vector<char> &is_inside, const Index &n)
  {
    const auto breaks = find_breaks(is_inside, n);
    const CellCounts blocks = count_blocks(is_inside, n, breaks);
    std::vector<CubeRange> result;
    const auto add_from = [&](const Index &lower)
    {
      Index end{};
      for (unsigned int d = 0; d < 3; ++d)
        end[d] = static_cast<int>(breaks[d].size());
      for (int i = lower[0] + 1; i < end[0]; ++i)
        for (int j = lower[1] + 1; j < end[1]; ++j)
          for (int k = lower[2] + 1; k < end[2]; ++k)
          {
            const CubeRange box = {lower, {i, j, k}};
            if (!blocks.is_filled(box))
              break; // nor are larger ones
            if (is_maximal(blocks, box))
              result.push_back({{breaks[0][lower[0]], breaks[1][lower[1]], breaks[2][lower[2]]},
                                {breaks[0][i], breaks[1][j], breaks[2][k]}});
          }
    };
    for (int i = 0; i + 1 < static_cast<int>(breaks[0].size()); ++i)
      for (int j = 0; j + 1 < static_cast<int>(breaks[1].size()); ++j)
        for (int k = 0; k + 1 < static_cast<int>(breaks[2].size()); ++k)
          add_from({i, j, k});
    return result;
  }
} // namespace plumbline::geometry
