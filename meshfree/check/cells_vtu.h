#pragma once

#include "geometry/node_cells.h"

#include <string>
#include <vector>

namespace plumbline::meshfree
{
  /// Write numbers that are constant on each cell, cells in triangles.
  /// @param names   of the columns, shape (n_columns)
  /// @param values  of the first cells, shape (n_cells, n_columns)
  /// @throws InputError  the file cannot be written
  void write_cells_vtu(const geometry::NodeCells<2> &cells, const std::vector<std::string> &names,
                       const std::vector<double> &values, const std::string &file);
} // namespace plumbline::meshfree
