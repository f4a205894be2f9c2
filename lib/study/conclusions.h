#pragma once

#include "scene/scene.h"
#include "study/study_results.h"

namespace plumbline::study
{
  /// From runs to answers: trends with verdicts, the scene's expectations held against them, advice
  /// which method to take, and what the scene did not need. Replaces what is there of these.
  void conclude(const scene::Scene &scene, StudyResults &results);
} // namespace plumbline::study
