#pragma once

#include "study/memory_estimate.h"
#include "study/rank_times.h"

namespace plumbline::report
{
  /// A table of estimated memory.
  /// @param available  to n_here ranks together [bytes]; infinite: not known
  /// @param n_here     1, or all ranks where they are not started and would run on this machine
  std::string memory_text(const std::vector<study::MemoryOfLevel> &estimates, unsigned int n_ranks,
                          double available, unsigned int n_here = 1);

  /// A table of predicted times and messages on each of so many ranks, after the constants that
  /// they are predicted with; a note if there are none.
  std::string times_text(const std::vector<study::TimeOfLevel> &times, unsigned int n_ranks,
                         const algebra::Rates &rates);
} // namespace plumbline::report
