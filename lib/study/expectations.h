#pragma once

#include "scene/scene.h"
#include "study/study_results.h"

namespace plumbline::study
{
  /// Hold the scene's Expected section against the trends of the decisive error; one line for each
  /// expectation and trend that it names. Replaces what is there of them. An expectation of a
  /// method, case or series that was not run does not hold.
  void check_expectations(const scene::Scene &scene, StudyResults &results);

  /// Expected/values: any scalar of an analysis, level by level. A shortened sweep is checked as
  /// far as it goes.
  void check_values(const scene::Scene &scene, StudyResults &results);
} // namespace plumbline::study
