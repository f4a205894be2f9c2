#pragma once

#include "report/view.h"

namespace plumbline::report
{
  /// Records that no other one beats in both error and CPU seconds, by rising error. None where a
  /// variable varies: they are of several problems.
  std::vector<const Record *> best_records(const StudyResults &results);

  /// Errors, costs, orders, energies.
  std::vector<DataChart> dynamics_charts(const StudyResults &results);
} // namespace plumbline::report
