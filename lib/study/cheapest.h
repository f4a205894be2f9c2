#pragma once

#include "study/study_results.h"

#include <string>
#include <vector>

namespace plumbline::study
{
  /// Costs this many times the least are a tie: CPU times of one solve repeat to 5 % where it is
  /// long, to 20 % at a millisecond, the best of three (solve_and_time).
  constexpr double tie_ratio = 1.2;

  /// So are costs that differ by less than this: from one run of a scene to the next the best of
  /// three solves of .1 to 1 ms differs by .1 to .15 ms [CPU s].
  constexpr double tie_seconds = 1.5e-4;

  /// Which of the runs to take: of those that tie with the least cost the one with the fewest
  /// unknowns, then by name. First that one, then the cheapest run of each other method within the
  /// tie, in the same order. Empty if there are no runs.
  std::vector<const Record *> cheapest(std::vector<const Record *> runs);

  /// An error of a run over how far its solution varies (see size_of()), for L2 norms times the
  /// root of the domain's area.
  double relative_error(const Record &run, const std::string &error);

  /// What relative_error() divides by, for an error "norm | target".
  std::string relative_to(const std::string &error);

  /// One line: target, method, h, relative error, time and ties.
  std::string words_of(const StudyResults &results, const Advice &advice, const Choice &choice);
} // namespace plumbline::study
