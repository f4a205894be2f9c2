#pragma once

#include "run.h"

namespace plumbline::app
{
  /// `plumbline run` of a scene with a time (Time/final time > 0), see analyse(): dynamics.html,
  /// .json, .md and dynamics/, and frames/ where Time/frames asks.
  /// @return exit code as of run(); solutions that blow up are no failure where the scene shows it
  int run_transient(const RunOptions &options, const scene::Scene &scene);
} // namespace plumbline::app
