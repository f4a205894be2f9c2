#pragma once

#include "measures.h"

namespace plumbline::app
{
  struct DispersionOptions : MeasureOptions
  {
    std::vector<double> angles{0, 22.5, 45}; ///< of the waves, from the first axis [degree]
  };

  /// Measure the waves of all methods over the sweep of a scene on lattices, beside those of the
  /// nonlocal operator and of its local limit, at density 1; print tables and verdicts, write
  /// dispersion.html, .md and .json with charts in dispersion/.
  /// That a method's waves are wrong is a finding, no error.
  /// @throws InputError  a scene that cannot be used, a folder that cannot be written
  /// @throws NumericalError  charts cannot be drawn; all else is written before that
  void dispersion(const DispersionOptions &options);
} // namespace plumbline::app
