#pragma once

#include "study/preflight.h"

#include <string>
#include <vector>

namespace plumbline::study
{
  /// The most memory that a process takes for a solution, above what stood before.
  struct MemoryEstimate
  {
    std::string what; ///< it solves, in words
    double bytes = 0; ///< see Method::expected_bytes; 0: little
  };

  struct MemoryOfLevel
  {
    std::string method, series;
    problem::Level level;
    /// Of the solution; of static ones also what an estimate of the error solves.
    MemoryEstimate largest;
  };

  /// What check_memory() and check_memory_of_motion() compare with the memory that there is, by
  /// method, series and level.
  /// @param n_levels  the first so many of each series; 0: all
  /// @param n_ranks   that share distributed data: slabs in space, rows of meshes
  std::vector<MemoryOfLevel> estimate_memory(const scene::Scene &scene, const Methods &methods,
                                             unsigned int n_levels, unsigned int n_ranks);
} // namespace plumbline::study
