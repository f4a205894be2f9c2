#pragma once

#include "study/statics.h"

namespace plumbline::study
{
  /// The problems and references of a level in space, before its first method.
  /// @throws NumericalError  a reference whose error is too large
  void open_statics_in_space(const Place &place, const Methods &available,
                             const StaticsOptions &options);

  /// Static solutions in space by one method at one level, a record for each case, as
  /// statics_analysis() has them in the plane.
  /// @param available  for the reference
  Records statics_in_space(const Place &place, const Method &method, const Methods &available,
                           const StaticsOptions &options);
} // namespace plumbline::study
