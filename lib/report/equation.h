#pragma once

#include "study/study_results.h"

#include <string>

namespace plumbline::report
{
  /// The problem that was solved as a line of HTML: its equation, kernel, horizons and constants,
  /// by the facts of study::add_model_facts. Empty without them, and for models that are not of
  /// this repository.
  std::string equation(const study::StudyResults &results);
} // namespace plumbline::report
