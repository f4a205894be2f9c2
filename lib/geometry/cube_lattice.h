#pragma once

#include "geometry/for_each_index.h"

#include <deal.II/base/point.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace plumbline::geometry
{
  struct Cuboid
  {
    dealii::Point<3> lower, upper; ///< [length]
  };

  /// A union of cuboids, minus other cuboids.
  struct Solid
  {
    std::vector<Cuboid> include, exclude;
  };

  /// A position is one of a box of n.
  inline bool is_within(const std::array<int, 3> &position, const std::array<int, 3> &n)
  {
    for (unsigned int d = 0; d < 3; ++d)
      if (position[d] < 0 || position[d] >= n[d])
        return false;
    return true;
  }

  /// Its number there, x fastest.
  inline std::size_t number_within(const std::array<int, 3> &position, const std::array<int, 3> &n)
  {
    return position[0] + static_cast<std::size_t>(n[0]) *
                             (position[1] + static_cast<std::size_t>(n[1]) * position[2]);
  }

  /// The cubes of Ω: those cells of a uniform lattice over the bounding box that a solid covers.
  /// Everything outside Ω within reach of the horizon is the interaction domain. Cell (i, j, k) is
  /// number i + n[0] (j + n[1] k) of the bounding box.
  class CubeLattice
  {
  public:
    /// @throws InputError  h <= 0; cuboids whose sides are not multiples of h apart; more than 1e9
    /// cells; no cell left; a cuboid to exclude that shares no cell with those to include
    CubeLattice(Solid solid, double h);

    /// The same solid in cubes of another size.
    CubeLattice at_spacing(double h) const { return {solid_, h}; }

    /// Cubes of n h make it up, too.
    bool fits(int n) const;

    double h() const { return h_; }
    const dealii::Point<3> &origin() const { return origin_; } ///< lower corner of cell (0,0,0)
    const std::array<int, 3> &n_cells() const { return n_; }   ///< of the bounding box
    std::size_t size() const { return size_; }                 ///< cells of Ω
    bool is_box() const { return is_inside_.empty(); }         ///< Ω fills its bounding box

    /// Which cells of the bounding box are in Ω, shape (n[2], n[1], n[0]); empty: all.
    const std::vector<char> &mask() const { return is_inside_; }

    bool is_inside(const std::array<int, 3> &cell) const
    {
      return is_within(cell, n_) && (is_box() || is_inside_[number(cell)] != 0);
    }

    /// A cell of Ω that contains a point or has it on its boundary, to 1e-9 h; none outside Ω.
    std::optional<std::array<int, 3>> cell_at(const dealii::Point<3> &x) const;

    std::size_t number(const std::array<int, 3> &cell) const { return number_within(cell, n_); }

    /// The bounding box.
    Cuboid cuboid() const { return cuboid({0, 0, 0}, n_); }

    /// The maximal boxes in Ω, which cover it and may overlap; if Ω is a box, Ω itself.
    std::vector<Cuboid> boxes() const;

    /// The coordinate of an axis that is so many cells from the origin.
    double coordinate(unsigned int axis, double s) const { return origin_[axis] + h_ * s; }

    /// visit(cell) for the cells of Ω, x fastest.
    template <class Visit>
    void for_each_cell(const Visit &visit) const
    {
      for_each_index({0, 0, 0}, n_,
                     [&](const std::array<int, 3> &cell)
                     {
                       if (is_inside(cell))
                         visit(cell);
                     });
    }

  private:
    Cuboid cuboid(const std::array<int, 3> &lower, const std::array<int, 3> &upper) const
    {
      return {{coordinate(0, lower[0]), coordinate(1, lower[1]), coordinate(2, lower[2])},
              {coordinate(0, upper[0]), coordinate(1, upper[1]), coordinate(2, upper[2])}};
    }
    std::vector<char> make_mask() const;

    Solid solid_;
    double h_;
    dealii::Point<3> origin_;
    std::array<int, 3> n_{};
    std::size_t size_ = 0;
    std::vector<char> is_inside_;
  };

  /// Nodes on a box of positions in space, some of them free. Vectors over them have shape
  /// (n_components, n[2], n[1], n[0]) and vanish where nodes are not free.
  struct BoxNodes
  {
    std::array<int, 3> n{};
    std::vector<char> is_free = {}; ///< shape (n[2], n[1], n[0]); empty: all are

    bool free(const std::array<int, 3> &at) const ///< false outside the box as well
    {
      return is_within(at, n) && (is_free.empty() || is_free[number_within(at, n)] != 0);
    }
    std::size_t n_positions() const { return static_cast<std::size_t>(n[0]) * n[1] * n[2]; }
    std::size_t n_free() const;
  };

  /// The centres of the cells; free are those of the cells in Ω.
  BoxNodes cell_centres(const CubeLattice &lattice);

  /// The vertices inside the bounding box, vertex (1, 1, 1) at position (0, 0, 0); free are those
  /// inside Ω, with all eight cells around them.
  BoxNodes inner_vertices(const CubeLattice &lattice);
} // namespace plumbline::geometry
