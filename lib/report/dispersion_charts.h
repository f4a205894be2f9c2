#pragma once

#include "report/charts.h"
#include "report/formats.h"
#include "study/dispersion.h"

namespace plumbline::report
{
  /// A chart of `plumbline dispersion`: dispersion/NAME.svg, its data in dispersion/NAME.csv.
  struct DispersionChart
  {
    std::string name;
    Plot plot;
    Table data;
  };

  /// For each series the longest wave's errors over its levels, where there are two; the phase
  /// speeds of all methods over the wavelength, for each polarisation and direction; and the group
  /// speeds in the first direction. The nonlocal operator's own curve lies behind these.
  std::vector<DispersionChart> dispersion_charts(const study::DispersionResults &results);

  /// Draw them into dir/dispersion, in one gnuplot process; charts.gp draws them again.
  /// @throws NumericalError  gnuplot is missing or fails; InputError  dir cannot be written
  void write_dispersion_charts(const std::vector<DispersionChart> &charts,
                               const std::filesystem::path &dir);
} // namespace plumbline::report
