#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace plumbline::geometry
{
  /// A range of cells [lower, upper) per axis of a lattice in space.
  struct CubeRange
  {
    std::array<int, 3> lower{}, upper{};
  };

  /// How many cells of a set lie in boxes of cells: each number takes eight sums (summed-area
  /// table).
  class CellCounts
  {
  public:
    /// @param is_inside  shape (n[2], n[1], n[0])
    CellCounts(const std::vector<char> &is_inside, const std::array<int, 3> &n);

    /// Of a range that may extend beyond the lattice, where no cell is in the set.
    std::size_t in(const CubeRange &range) const;

    bool is_filled(const CubeRange &range) const; ///< all of its cells are in the set

  private:
    std::size_t index(const std::array<int, 3> &corner) const
    {
      return corner[0] +
             (n_[0] + std::size_t{1}) * (corner[1] + (n_[1] + std::size_t{1}) * corner[2]);
    }

    std::array<int, 3> n_;
    std::vector<std::size_t> below_; ///< below a corner: shape (n_[2] + 1, n_[1] + 1, n_[0] + 1)
  };
} // namespace plumbline::geometry
