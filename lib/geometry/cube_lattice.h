#pragma once

#include <deal.II/base/point.h>

#include <array>
#include <cstddef>

namespace plumbline::geometry
{
  struct Cuboid
  {
    dealii::Point<3> lower, upper; ///< [length]
  };

  /// The cubes of side h that fill a cuboid. Everything outside it within reach of the horizon is
  /// the interaction domain. Cell (i, j, k) is number i + n[0] (j + n[1] k).
  class CubeLattice
  {
  public:
    /// @throws InputError  h <= 0, sides that are not multiples of h, more than 1e9 cells
    CubeLattice(const Cuboid &cuboid, double h);

    double h() const { return h_; }
    const dealii::Point<3> &origin() const { return origin_; } ///< lower corner of cell (0,0,0)
    const std::array<int, 3> &n_cells() const { return n_; }
    Cuboid cuboid() const
    {
      return {origin_, {coordinate(0, n_[0]), coordinate(1, n_[1]), coordinate(2, n_[2])}};
    }
    std::size_t size() const { return static_cast<std::size_t>(n_[0]) * n_[1] * n_[2]; }

    /// The coordinate of an axis that is so many cells from the origin.
    double coordinate(unsigned int axis, double s) const { return origin_[axis] + h_ * s; }

  private:
    double h_;
    dealii::Point<3> origin_;
    std::array<int, 3> n_;
  };
} // namespace plumbline::geometry
