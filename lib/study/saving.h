#pragma once

#include "analysis/statics.h"
#include "scene/problem.h"
#include "study/results.h"

#include <optional>

namespace plumbline::study
{
  using analysis::Solution;
  using method::Method;

  /// One level by the full model as well: what the smallest one saves, and that nothing is missed.
  /// @param solution  by the smallest model, and its cost
  /// Nothing if there is no fuller model, or the method cannot solve it.
  /// Cost: that of the full model, tens to hundreds of times the smallest one's.
  std::optional<Saving> measure_saving(const scene::Case &one, const Method &method,
                                       const Solution &solution);
} // namespace plumbline::study
