#pragma once

#include "report/data_charts.h"
#include "study/dynamics.h"

namespace plumbline::report
{
  /// Those that the results have points for: errors over levels and over CPU seconds, errors in
  /// time over steps, energies and their balance, errors over time.
  std::vector<DataChart> motion_charts(const study::DynamicResults &results);
} // namespace plumbline::report
