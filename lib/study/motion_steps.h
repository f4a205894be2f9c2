#pragma once

#include "analysis/transient.h"
#include "scene/scene.h"

namespace plumbline::study
{
  /// A step as the scene says it.
  struct StepRule
  {
    double value = 0;
    bool is_fraction = false;

    std::string text(int n_digits = 4) const;
  };

  std::vector<StepRule> step_rules(const scene::TimeSection &time);

  /// Schemes without a critical step take the fractions of velocity Verlet's. [time]
  double step_of(const StepRule &rule, const analysis::Transient &transient,
                 const analysis::Scheme &scheme);
} // namespace plumbline::study
