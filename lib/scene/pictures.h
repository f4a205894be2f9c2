#pragma once

#include "uq/grid_field.h"

#include <string>
#include <vector>

namespace plumbline::scene
{
  /// Fields from files: each file is a grid of numbers that covers the box, one line for each row
  /// of cells, beginning at the upper side (see read_number_grid). A field is constant in each
  /// cell; outside the box it has the value at the nearest point of the box.
  /// @param files   file names
  /// @param folder  to which the names are relative
  /// @param box     with an area [length]
  /// @return        a field for each file, all on the same grid
  /// @throws InputError  as read_number_grid, files of different sizes, not enough memory
  /// @pre files is not empty
  std::vector<uq::GridField> read_pictures(const std::vector<std::string> &files,
                                           const std::string &folder, const geometry::Box &box);
} // namespace plumbline::scene
