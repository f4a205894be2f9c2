#pragma once

#include "study/memory_estimate.h"

namespace plumbline::report
{
  /// A table of estimated memory.
  /// @param available  of one process [bytes]; infinite: not known
  std::string memory_text(const std::vector<study::MemoryOfLevel> &estimates, unsigned int n_ranks,
                          double available);
} // namespace plumbline::report
