#pragma once

#include "study/sampling.h"

namespace plumbline::study
{
  /// For each method, level, rule and number of modes: whether the error of the mean is limited by
  /// the number of samples, or by errors that more samples do not reduce. A set is as accurate as
  /// the largest one if its error is within a tenth of that one's, or within rounding. There is no
  /// result with fewer than two sets with errors, nor for the level that is the target, whose
  /// errors are those of sampling alone.
  std::vector<SamplingBalance> find_balance(const std::vector<CaseStatistics> &cases);

  /// One sentence.
  /// @param has_modes  the number of modes differs from set to set, and is named
  /// @param has_rules  so does the rule
  std::string words_of(const SamplingBalance &balance, bool has_modes, bool has_rules = false);
} // namespace plumbline::study
