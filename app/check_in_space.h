#pragma once

#include "check.h"
#include "requirements.h"

namespace plumbline::app
{
  /// Check weights of another code in space: moments, elastic constants, pairs, and on lattices
  /// whose rule they are. Print what is found; with an output folder write check.json.
  /// @pre     scene.domain.is_in_space()
  /// @return  exit code: 0, or 1: a requirement that does not hold, an outlier, a cause found
  /// @throws InputError  files that cannot be used; nodes whose spacing no level of the scene has
  int check_in_space(const scene::Scene &scene, const CheckOptions &options,
                     const Requirements &required);
} // namespace plumbline::app
