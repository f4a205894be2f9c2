#pragma once

#include "run.h"
#include "scene/scene.h"

namespace plumbline::app
{
  /// `plumbline run` of a scene that moves (Time/final time > 0): dynamics.html, .json, .md and
  /// dynamics/; while it goes on, dynamics.jsonl with a line for each motion that has ended.
  /// @return exit code as of run(); motions that blow up are no failure where the scene shows it
  int run_motions(const RunOptions &options, const scene::Scene &scene);
} // namespace plumbline::app
