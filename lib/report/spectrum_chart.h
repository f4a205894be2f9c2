#pragma once

#include "report/data_charts.h"

namespace plumbline::report
{
  /// What each mode of a random field holds of its variance, and all up to it.
  /// @param words  as of uq::words_of
  DataChart spectrum_chart(const std::vector<double> &share, const std::vector<double> &kept,
                           const std::string &words);
} // namespace plumbline::report
