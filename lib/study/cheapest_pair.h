#pragma once

#include "study/sampling.h"

namespace plumbline::study
{
  /// Of each problem and series the pairs of a mesh size and a number of samples that reach errors
  /// of the mean of 1e-1, 1e-2, ... of its size in the least time, as far as there are any. More
  /// samples and finer levels must stay below the target; of pairs that tie, the simplest one. None
  /// at a level that errors are held against, where nothing is known of the mesh's.
  std::vector<CheapestPair> find_cheapest(const std::vector<CaseStatistics> &cases);
} // namespace plumbline::study
