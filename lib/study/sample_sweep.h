#pragma once

#include "scene/scene.h"
#include "study/analysis.h"
#include "study/sampling.h"
#include "study/statics.h"

namespace plumbline::study
{
  /// All methods at all levels of a sample: errors as in results.json, and the field that the
  /// decisive error is about, nodal values or averages over the comparison cells.
  /// @throws NumericalError  a method has no solution
  std::vector<SampleCase> sweep_sample(const scene::Scene &scene, const Methods &methods,
                                       const Methods &available);

  /// The records of an analysis by the scalars and the field that samples count.
  /// @throws NumericalError  a record has a failure
  std::vector<SampleCase> sample_study(const Analysis &analysis, const scene::Scene &scene,
                                       const Methods &available);
} // namespace plumbline::study
