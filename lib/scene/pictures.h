#pragma once

#include "uq/grid_field.h"

#include <string>
#include <vector>

namespace plumbline::scene
{
  /// Fields that are given as pictures: each file is a grid of numbers that fills the box, a line
  /// for each row of cells, the first one along the upper side (see read_number_grid). A field is
  /// constant in each cell, and beyond the box what it is at the nearest point.
  /// @param files   their names
  /// @param folder  that the names begin in
  /// @param box     with an area [length]
  /// @return        a field for each file, all on the same grid
  /// @throws InputError  as read_number_grid, files of different sizes, not enough memory
  /// @pre files is not empty
  std::vector<uq::GridField> read_pictures(const std::vector<std::string> &files,
                                               const std::string &folder, const geometry::Box &box);
} // namespace plumbline::scene
