#pragma once

#include "geometry/ball_cell.h"
#include "geometry/cube_lattice.h"
#include "geometry/lattice.h"

#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace plumbline::geometry
{
  /// Finds boxes that come near a place. Boxes of like size (within a factor of two) share a grid
  /// of square or cubic bins, about 2 n of them for n boxes, each box in the bin of its lower
  /// corner; a query looks at a few bins of every grid. So memory is O(n) for any sizes, and a
  /// query that is not larger than the boxes takes O(1), times the number of grids if sizes are
  /// graded: .2 µs out of 1e5 boxes, and 10 to 25 ns for each one found. Not for: boxes of one size
  /// nearly all of which crowd in a tiny part of the space they span; a query there looks at all of
  /// them.
  template <int dim>
  class BoxSearch
  {
  public:
    using Box = std::conditional_t<dim == 2, geometry::Box, Cuboid>;

    /// @param boxes  of the things to find, sides of length zero allowed; the search keeps a copy
    /// @throws InputError  a box whose corners are not finite or whose upper one is below the lower
    explicit BoxSearch(std::vector<Box> boxes);

    /// Indices of all boxes that share a point with the given one, ascending, each once. Thread
    /// safe.
    /// @param found  overwritten
    void find(const Box &box, std::vector<unsigned int> &found) const;

    const Box &box(unsigned int index) const { return boxes_[index]; }

  private:
    struct Member
    {
      Box box;
      unsigned int index = 0;
    };

    struct Grid
    {
      Point<dim> origin;
      double bin_size = 0; ///< at least the sides of the boxes
      std::array<std::size_t, 3> n_bins{1, 1, 1};
      std::vector<std::size_t> start; ///< of each bin in members, x fastest, and the end
      std::vector<Member> members;    ///< of all bins

      /// Along an axis, from -1 to n_bins.
      double bin(double x, unsigned int axis) const;
    };

    Grid make_grid(const std::vector<unsigned int> &members) const;

    std::vector<Box> boxes_;
    std::vector<Grid> grids_;
  };

  /// @param vertices  at least one
  Box bounding_box(ArrayView<const Point<2>> vertices);
} // namespace plumbline::geometry
