#pragma once

#include "base/choice.h"
#include "geometry/lattice.h"

#include <algorithm>
#include <array>
#include <vector>

namespace plumbline::uq
{
  using geometry::Box;
  using geometry::Point;

  /// A box cut into nx × ny equal rectangles, each with a node at its centre. Vectors over its
  /// nodes have shape (n[1], n[0]): x runs fastest.
  struct Grid
  {
    Box box;                ///< [length]
    std::array<int, 2> n{}; ///< cells along x and y

    std::size_t size() const { return static_cast<std::size_t>(n[0]) * n[1]; }
    double h(unsigned int axis) const { return side(axis) / n[axis]; } ///< [length]
    double side(unsigned int axis) const { return box.upper[axis] - box.lower[axis]; }
    double cell_area() const { return h(0) * h(1); } ///< [length^2]
    Point<2> node(int i, int j) const;               ///< the centre of cell (i, j)
  };

  /// @throws InputError  a box without area, or no cells along x or y
  void check(const Grid &grid);

  /// A grid over a box whose cells are as near to squares of side h as whole numbers of them allow.
  /// @throws InputError  h <= 0, a box without area, or more than 1e8 cells
  Grid make_grid(const Box &box, double h);

  /// What a field is between the nodes of its grid.
  enum class Interpolation
  {
    linear,  ///< bilinear between nodes, the same as at the nearest edge of their hull outside it
    constant ///< in a cell as at its node
  };

  /// A field given by its values at the nodes of a grid. Beyond the box it is what it is at the
  /// nearest point of the box. Cost: 5 ns for a point (linear).
  class GridField
  {
  public:
    GridField() = default;
    /// @param values  at the nodes, shape (n[1], n[0])
    GridField(const Grid &grid, std::vector<double> values,
              Interpolation between = Interpolation::linear);

    double operator()(const Point<2> &x) const;

    const Grid &grid() const { return grid_; }
    const std::vector<double> &values() const { return values_; }

    /// The mean over the box and the least and largest value at nodes.
    double mean() const;
    double smallest() const;
    double largest() const;

  private:
    Grid grid_;
    std::vector<double> values_;
    Interpolation between_ = Interpolation::linear;
    std::array<double, 2> per_length_{}; ///< 1/h
  };

  inline double GridField::operator()(const Point<2> &x) const
  {
    // in cells from the lower corner
    const double s = (x[0] - grid_.box.lower[0]) * per_length_[0];
    const double t = (x[1] - grid_.box.lower[1]) * per_length_[1];
    const int n0 = grid_.n[0], n1 = grid_.n[1];
    if (between_ == Interpolation::constant)
    {
      const auto i = static_cast<int>(std::clamp(s, 0., n0 - 1.));
      const auto j = static_cast<int>(std::clamp(t, 0., n1 - 1.));
      return values_[static_cast<std::size_t>(j) * n0 + i];
    }
    const double u = std::clamp(s - .5, 0., n0 - 1.), v = std::clamp(t - .5, 0., n1 - 1.);
    const int i = static_cast<int>(u), j = static_cast<int>(v);
    const double a = u - i, b = v - j;
    const double *const row = values_.data() + static_cast<std::size_t>(j) * n0 + i;
    // the neighbour is not read where its weight is 0: there may be none
    const std::size_t right = a > 0 ? 1 : 0, up = b > 0 ? n0 : 0;
    return (1 - b) * ((1 - a) * row[0] + a * row[right]) +
           b * ((1 - a) * row[up] + a * row[up + right]);
  }
} // namespace plumbline::uq

template <>
inline constexpr auto plumbline::base::words<plumbline::uq::Interpolation> =
    std::array{"linear", "constant"};
