#pragma once

#include "study/study_results.h"

#include <string>

namespace plumbline::study
{
  /// What the decisive error holds methods against: "the exact solution of the nonlocal problem
  /// (Problem/solution)", "the solution of the local limit", "the reference solution by Q2",
  /// "each method's own finest level".
  std::string target_words(const StudyResults &results);

  /// Whether it holds methods at a fixed horizon against the local solution, from which all of them
  /// differ in the end by what the models differ: nothing converges or stalls there.
  bool is_between_models(const StudyResults &results);
} // namespace plumbline::study
