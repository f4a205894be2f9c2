#pragma once

#include "report/formats.h"
#include "report/plot.h"
#include "study/dynamics.h"

namespace plumbline::report
{
  /// A picture, dynamics/NAME.svg, and its data, dynamics/NAME.csv.
  struct MotionChart
  {
    std::string name, caption;
    Plot plot;
    Table data;
  };

  /// Those that the results have points for: errors over levels and over CPU seconds, errors in
  /// time over steps, energies and their balance, errors over time.
  std::vector<MotionChart> motion_charts(const study::DynamicResults &results);

  /// @throws NumericalError  gnuplot is missing or fails; InputError  dir cannot be written
  void write_motion_charts(const std::vector<MotionChart> &charts,
                           const std::filesystem::path &dir);
} // namespace plumbline::report
