#pragma once

#include "report/formats.h"
#include "study/results.h"

#include <string>

namespace plumbline::report
{
  /// Of a solution in space: the surfaces on which u (|u| of vectors) has a quarter, half and three
  /// quarters of its range, by trilinear interpolation between the centres of blocks; none within
  /// half a block of the boundary. By deal.II's marching cubes.
  /// @return commands of gnuplot; empty where no surface can be drawn: u is constant, or the body
  /// is one block thick
  std::string surfaces_script(const study::SolutionBlocks &blocks, const std::string &file);

  /// "u, m = 3, h = 0.05: surfaces of equal u computed with Q1".
  std::string surfaces_title(const study::SolutionBlocks &blocks);

  /// A row for each block inside the domain, at its centre.
  Table blocks_table(const study::SolutionBlocks &blocks);
} // namespace plumbline::report
