#pragma once

#include "scene/scene.h"
#include "study/analysis.h"
#include "study/sampling.h"

namespace plumbline::study
{
  /// The records of an analysis with no more than the scalars and the field that samples count, and
  /// its variants as methods.
  /// @param ranks  that run it together
  /// @throws NumericalError  a record has a failure
  Records sample_study(const Analysis &analysis, const scene::Scene &scene,
                       const Methods &available,
                       const base::Communicator &ranks = base::Communicator::alone());
} // namespace plumbline::study
