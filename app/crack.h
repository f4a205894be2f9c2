#pragma once

#include "measures.h"

namespace plumbline::app
{
  struct CrackOptions : MeasureOptions
  {
    bool check = false; ///< Expected/crack
  };

  /// Find the threshold of every level of a scene with a notched strip (section Crack), and let the
  /// crack move at the last one of the first series; print tables, write crack.html, .md and .json,
  /// crack/ with pictures, frames/ with states as VTU, and while it moves checkpoint.h5, from which
  /// the same command goes on after it was killed.
  /// @return  1 if check is set and the crack does not do what is expected, else 0
  /// @throws InputError  a scene that cannot be used, no room for its frames, a folder that cannot
  /// be written
  /// @throws NumericalError  the motion fails; pictures cannot be drawn, all else is written then
  int crack(const CrackOptions &options);
} // namespace plumbline::app
