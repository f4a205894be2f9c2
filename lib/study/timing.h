#pragma once

#include "analysis/statics.h"
#include "study/study_results.h"

#include <functional>
#include <string>
#include <vector>

namespace plumbline::study
{
  /// Solutions with their times: solves shorter than .02 CPU s, which are mostly noise, are
  /// repeated twice, and the fastest counts. On several ranks, which must agree, nothing is
  /// repeated.
  std::vector<analysis::Outcome>
  solve_and_time(const std::function<std::vector<analysis::Outcome>()> &solve);

  bool is_same_run(const Record &run, const std::string &method, const std::string &problem,
                   const std::string &series, unsigned int level);
} // namespace plumbline::study
