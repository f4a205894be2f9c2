#pragma once

#include "study/study_results.h"

#include <string>

namespace plumbline::io
{
  /// What types do not say of results that were read: lengths are positive numbers, lists that
  /// belong together are as long as each other, boxes of maps are not empty.
  /// @param what  opens messages, e.g. "results file 'results.json'"
  /// @throws InputError  naming the place in the file
  void check_results(const study::StudyResults &results, const std::string &what);
} // namespace plumbline::io
