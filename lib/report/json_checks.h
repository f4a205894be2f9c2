#pragma once

#include "study/results.h"

#include <string>

namespace plumbline::report
{
  /// What types do not say of results that were read: lengths are positive numbers, lists that
  /// belong together are as long as each other, boxes of maps are not empty.
  /// @param what  opens messages, e.g. "results file 'results.json'"
  /// @throws InputError  naming the place in the file
  void check_results(const study::Results &results, const std::string &what);
} // namespace plumbline::report
