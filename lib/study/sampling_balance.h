#pragma once

#include "study/sampling.h"

namespace plumbline::study
{
  /// Of each method, level and rule, and of each number of modes, what limits the error of the
  /// mean: samples, or what they cannot mend. A set says as much as the largest one where its error
  /// is within a tenth of that one's, or within rounding. None of fewer than two sets with errors,
  /// nor of a level that errors are held against, where samples are all there is.
  std::vector<SamplingBalance> find_balance(const std::vector<CaseStatistics> &cases);

  /// One sentence.
  /// @param has_modes  how many modes vary differs from set to set
  /// @param has_rules  so does the rule
  std::string words_of(const SamplingBalance &balance, bool has_modes, bool has_rules = false);
} // namespace plumbline::study
