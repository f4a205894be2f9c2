#pragma once

#include "driver/scene_input.h"

namespace plumbline::driver
{
  struct SampleOptions : SceneOptions
  {
    bool check = false;        ///< Expected/sampling
    std::string growth_solver; ///< of a worker, instead of the scene's; records do not depend on it
  };

  /// Take a random scene at the samples of its section Sampling: statics ('plumbline run') or
  /// growth ('plumbline grow'), in processes of their own, and on several ranks each its part.
  /// Print tables, write sample.html, .md and .json, sample/ with tables and pictures, and samples/
  /// with a record of each, from which the same command goes on.
  /// @return  0; 1 if check is set and something is not as expected; 3 if a sample failed, the
  /// others being there; 130 if interrupted
  /// @throws InputError  a scene that cannot be used, a folder that cannot be written
  /// @throws NumericalError  pictures cannot be drawn, all else is written then
  /// @note Collective.
  int sample(const SampleOptions &options);
} // namespace plumbline::driver
