#pragma once

#include "run.h"

namespace plumbline::app
{
  /// Print the memory that each rank is expected to take, by method and level; nothing is run.
  /// @return exit code 0, also where it does not fit
  /// @throws InputError  a scene that cannot be run, or whose memory is not estimated
  int print_estimate(const RunOptions &options, const scene::Scene &scene);
} // namespace plumbline::app
