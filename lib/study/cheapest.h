#pragma once

#include "study/results.h"

#include <vector>

namespace plumbline::study
{
  /// Costs this many times the least are a tie: CPU times of one solve repeat to 5 % where it is
  /// long, to 20 % at a millisecond, the best of three (solve_and_time).
  constexpr double tie_ratio = 1.2;

  /// Which of the runs to take: of those within `tie_ratio` of the least cost the one with the
  /// fewest unknowns, then by name. First that one, then the cheapest run of each other method
  /// within the tie, in the same order. Empty if there are no runs.
  std::vector<const Run *> cheapest(std::vector<const Run *> runs);
} // namespace plumbline::study
