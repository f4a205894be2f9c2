#pragma once

#include "report/data_charts.h"
#include "study/growth.h"

namespace plumbline::report
{
  /// load (reaction over the load), energies, tip: over the events.
  std::vector<DataChart> growth_charts(const study::GrowthResults &results);

  /// All events, a row each.
  Table growth_events_table(const study::GrowthResults &results);

  /// Write grow/events.csv, sides.csv (the crack's path), the charts, moments.svg, the damage at
  /// six moments, and where G varies microstructure.svg, the crack over it.
  /// @throws InputError  dir cannot be written
  /// @throws NumericalError  gnuplot is missing or fails
  void write_growth_pictures(const study::GrowthResults &results, const std::filesystem::path &dir);
} // namespace plumbline::report
