#pragma once

#include "study/stability.h"

#include <filesystem>
#include <string>
#include <vector>

namespace plumbline::report
{
  /// A picture of `plumbline stability`: stability/NAME.svg.
  struct StabilityPicture
  {
    std::string name, title;
    bool is_mode = false; ///< else a chart, with its data in stability/NAME.csv
  };

  /// Charts of the coercivity constant, the largest eigenvalue and ‖A⁻¹M‖∞ over each series of at
  /// least two levels; the lowest modes of all methods over a series; the zero modes of each method
  /// that has some. Modes are of the finest level with at most 1600 nodes, so that each is seen.
  std::vector<StabilityPicture> list_pictures(const study::StabilityResults &results);

  /// Draw all of them into dir/stability, in one gnuplot process; pictures.gp draws them again.
  /// @throws NumericalError  gnuplot is missing or fails; InputError  dir cannot be written
  void write_pictures(const study::StabilityResults &results, const std::filesystem::path &dir);
} // namespace plumbline::report
