#pragma once

#include "measures.h"
#include "method/method.h"
#include "study/stability.h"

namespace plumbline::app
{
  struct StabilityOptions : MeasureOptions
  {
    bool check = false;
  };

  using StabilityControl = MeasureControl<study::StabilityRow>;

  /// The operators of methods over the sweep of a scene, on displacements alone.
  /// @param on_finest  called with each row of a series' finest level, those of earlier, too
  /// @throws InputError  a method that shows no operator; what else fails is in its row
  study::StabilityResults
  measure_stability(scene::Scene scene, const method::Methods &methods, unsigned int n_levels,
                    const StabilityControl &control = {},
                    const std::function<void(const study::StabilityRow &)> &on_finest = {});

  /// Measure the operators of all methods over the sweep of a scene; print tables and verdicts,
  /// write stability.html, .md and .json with pictures in stability/, and the modes of each series'
  /// finest level to stability/*.vtu. A command that was interrupted or killed takes over what it
  /// had finished, from stability.jsonl.
  /// @return exit code: 0, or with check 1 if Expected/stability does not hold; that a method is
  ///         unstable is a finding, no error; 130 if it was interrupted: what was finished is there
  /// @throws InputError  a scene that cannot be used, a folder that cannot be written
  /// @throws NumericalError  pictures cannot be drawn; all else is written before that
  int stability(const StabilityOptions &options);
} // namespace plumbline::app
