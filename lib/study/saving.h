#pragma once

#include "analysis/statics.h"
#include "scene/problem.h"
#include "scene/scene.h"
#include "study/results.h"

#include <optional>

namespace plumbline::study
{
  using analysis::Solution;
  using method::Method;

  /// Whether Solver/model = full would build anything besides what this scene's solves build, and
  /// can: not with a given collar or operator, which a full model has no use for.
  bool has_fuller_model(const scene::Scene &scene);

  /// One level by the full model as well: what the smallest one saves, and that nothing is missed.
  /// @param solution  by the smallest model, and its cost
  /// Nothing if the method cannot solve the full model.
  /// Cost: that of the full model, tens to hundreds of times the smallest one's.
  std::optional<Saving> measure_saving(const scene::Case &one, const Method &method,
                                       const Solution &solution);
} // namespace plumbline::study
