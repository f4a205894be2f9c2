#pragma once

#include "measures.h"

namespace plumbline::app
{
  struct GrowOptions : MeasureOptions
  {
    bool check = false; ///< Expected/growth, growth ends, and the audit of energy
  };

  /// Let a crack grow in equilibrium, bond by bond, as section Fracture of a scene says; print
  /// tables, write grow.html, .md and .json, grow/ with tables and pictures, and while it grows
  /// checkpoint.h5, from which the same command goes on after it was killed.
  /// @return  1 if check is set and something is not as expected, else 0
  /// @throws InputError  a scene that cannot be used, a folder that cannot be written
  /// @throws NumericalError  the equations cannot be solved; pictures cannot be drawn, all else is
  /// written then
  int grow(const GrowOptions &options);
} // namespace plumbline::app
