#pragma once

#include "report/charts.h"
#include "report/data_charts.h"
#include "study/dispersion.h"

namespace plumbline::report
{
  /// Those of `plumbline dispersion`: for each series the longest wave's errors over its levels,
  /// where there are two; the phase speeds of all methods over the wavelength, for each
  /// polarisation and direction; and the group speeds in the first direction. The nonlocal
  /// operator's own curve lies behind these.
  std::vector<DataChart> dispersion_charts(const study::DispersionResults &results);
} // namespace plumbline::report
