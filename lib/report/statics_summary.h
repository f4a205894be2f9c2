#pragma once

#include "study/study_results.h"

#include <filesystem>
#include <string>

namespace plumbline::report
{
  /// What a static study found, in at most 25 lines of 120 columns with the answer last; the report
  /// has the rest.
  std::string statics_summary(const study::StudyResults &results,
                              const std::filesystem::path &folder);
} // namespace plumbline::report
