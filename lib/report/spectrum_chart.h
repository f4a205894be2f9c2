#pragma once

#include "uq/spectrum.h"
#include "report/data_charts.h"

namespace plumbline::report
{
  /// What each mode of a random field holds of its variance, and all up to it.
  DataChart spectrum_chart(const uq::Spectrum &spectrum);
} // namespace plumbline::report
