#pragma once

#include "scene/scene.h"
#include "study/results.h"

namespace plumbline::study
{
  /// Hold the scene's Expected section against the trends of the decisive error; one line for each
  /// expectation and trend that it names. Replaces what is there of them. An expectation of a
  /// method, case or series that was not run does not hold.
  void check_expectations(const scene::Scene &scene, Results &results);
} // namespace plumbline::study
