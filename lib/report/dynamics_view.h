#pragma once

#include "report/view.h"

namespace plumbline::report
{
  /// The decisive error of a record at the final time; NaN where it has none.
  double decisive_error(const StudyResults &results, const Record &record);

  /// Records that no other one beats in both error and CPU seconds, by rising error. None where a
  /// variable varies: they are of several problems.
  std::vector<const Record *> best_records(const StudyResults &results);

  /// Errors, costs, orders, energies.
  std::vector<DataChart> dynamics_charts(const StudyResults &results);
} // namespace plumbline::report
