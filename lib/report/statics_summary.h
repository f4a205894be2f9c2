#pragma once

#include "study/study_results.h"

#include <filesystem>
#include <string>
#include <vector>

namespace plumbline::report
{
  /// How many of the scene's expectations hold, after those that do not.
  std::vector<std::string> expectation_lines(const study::StudyResults &results, std::size_t most);

  /// What a static study found, in at most 25 lines of 120 columns with the answer last; the report
  /// has the rest.
  std::string statics_summary(const study::StudyResults &results,
                              const std::filesystem::path &folder);
} // namespace plumbline::report
