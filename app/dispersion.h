#pragma once

#include "measures.h"
#include "method/method.h"
#include "study/dispersion.h"

namespace plumbline::app
{
  const std::vector<double> usual_angles = {0, 22.5, 45};

  struct DispersionOptions : MeasureOptions
  {
    std::vector<double> angles = usual_angles; ///< of the waves, from the first axis [degree]
  };

  using DispersionControl = MeasureControl<study::DispersionRow>;

  /// The waves of methods over the sweep of a scene.
  /// @throws InputError  a scene without waves of one stencil; what else fails is in its row
  study::DispersionResults measure_dispersion(const scene::Scene &scene,
                                              const method::Methods &methods,
                                              const std::vector<double> &angles,
                                              unsigned int n_levels,
                                              const DispersionControl &control = {});

  /// Measure the waves of all methods over the sweep of a scene on lattices, beside those of the
  /// nonlocal operator and of its local limit, at density 1; print tables and verdicts, write
  /// dispersion.html, .md and .json with charts in dispersion/. A command that was interrupted or
  /// killed takes over what it had finished, from dispersion.jsonl.
  /// @return exit code: 0, or 130 if it was interrupted: what was finished is there; that a
  ///         method's waves are wrong is a finding, no error
  /// @throws InputError  a scene that cannot be used, a folder that cannot be written
  /// @throws NumericalError  charts cannot be drawn; all else is written before that
  int dispersion(const DispersionOptions &options);
} // namespace plumbline::app
