#pragma once

#include "report/data_charts.h"
#include "uq/spectrum.h"

namespace plumbline::report
{
  /// What each mode of a random field holds of its variance, and all up to it.
  DataChart spectrum_chart(const uq::Spectrum &spectrum);
} // namespace plumbline::report
