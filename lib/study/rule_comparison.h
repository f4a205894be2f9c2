#pragma once

#include "study/sampling.h"

namespace plumbline::study
{
  /// Of each method at its finest level, for the errors of mean and deviation: how many samples
  /// each rule needs for the same error. None where fewer than two rules have errors; a set that
  /// errors are held against has none.
  std::vector<RuleComparison> compare_rules(const std::vector<CaseStatistics> &cases);

  /// One sentence.
  std::string words_of(const RuleComparison &comparison);
} // namespace plumbline::study
