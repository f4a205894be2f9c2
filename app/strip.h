#pragma once

#include "measures.h"

namespace plumbline::app
{
  struct StripOptions : MeasureOptions
  {
    bool check = false; ///< Expected/strip, and that no strip is too short
  };

  /// Solve strips with a standing crack by all methods at all levels of a scene; print tables,
  /// write strip.html, .md and .json, and strip/ with pictures and their data.
  /// @return  1 if check is set and something is not as expected, else 0
  /// @throws InputError  a scene or method that cannot be used, a folder that cannot be written
  /// @throws NumericalError  pictures cannot be drawn, all else is written then
  int strip(const StripOptions &options);
} // namespace plumbline::app
