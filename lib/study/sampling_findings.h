#pragma once

#include "study/sampling.h"

namespace plumbline::study
{
  /// What a reader should know of the rule, its samples and the field's modes; a sentence each.
  std::vector<std::string> find_findings(const SamplingResults &results);
} // namespace plumbline::study
