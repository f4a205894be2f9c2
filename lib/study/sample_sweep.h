#pragma once

#include "scene/scene.h"
#include "study/analysis.h"
#include "study/sampling.h"

namespace plumbline::study
{
  /// The records of an analysis by the scalars and the field that samples count.
  /// @param ranks  that run it together
  /// @throws NumericalError  a record has a failure
  std::vector<SampleCase>
  sample_study(const Analysis &analysis, const scene::Scene &scene, const Methods &available,
               const base::Communicator &ranks = base::Communicator::alone());
} // namespace plumbline::study
