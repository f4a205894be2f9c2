#pragma once

#include "study/sampling.h"

namespace plumbline::study
{
  /// For each method at its finest level, and for the errors of mean and deviation: how many
  /// samples each rule needs for the same error. There is no comparison where fewer than two rules
  /// have sets with errors; a set that is the target has no error.
  std::vector<RuleComparison> compare_rules(const std::vector<CaseStatistics> &cases);

  /// One sentence.
  std::string words_of(const RuleComparison &comparison);
} // namespace plumbline::study
