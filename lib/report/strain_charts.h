#pragma once

#include "report/data_charts.h"
#include "study/strain_growth.h"

namespace plumbline::report
{
  /// For each series and direction of the strain, growth rates over X = β ε g²: of the symbol, of
  /// the local criterion (64), and observed by each method.
  std::vector<DataChart> strain_charts(const std::vector<study::StrainGrowth> &growths);

  /// When waves begin to grow, one row for each series and direction.
  Table strain_thresholds_table(const std::vector<study::StrainGrowth> &growths);
  extern const char *const strain_thresholds_words;

  /// How near methods come, one row for each series, direction and method.
  Table strain_growth_table(const std::vector<study::StrainGrowth> &growths);
  extern const char *const strain_growth_words;
} // namespace plumbline::report
