#pragma once

#include "report/formats.h"
#include "study/results.h"

#include <string>

namespace plumbline::report
{
  /// Of a solution in space: the surfaces on which u (|u| of vectors) has a quarter, half and three
  /// quarters of its range, by deal.II's marching cubes, trilinear between the centres of eight
  /// cells of the grid that lie in the body. So none within half a spacing of the boundary, and
  /// none in parts that are one cell of the grid thick.
  /// @return commands of gnuplot; empty where no surface can be drawn: u is constant up to
  /// round-off, or no eight cells lie together in the body
  std::string surfaces_script(const study::SolutionGrid &grid, const std::string &file);

  /// "u, m = 3, h = 0.05: isosurfaces of u computed with Q1".
  std::string surfaces_title(const study::SolutionGrid &grid);

  /// A row for each cell of the grid inside the domain, at its centre.
  Table grid_table(const study::SolutionGrid &grid);
} // namespace plumbline::report
