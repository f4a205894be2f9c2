#pragma once

#include "method/rice_strip.h"
#include "physics/kernel.h"
#include "reference/shapes.h"

namespace plumbline::reference
{
  /// Bonds are whole or cut point by point, see BondPairs; continuous functions are two on the
  /// crack's sides and one at its tip, so that it opens with zero there.
  /// @param kernel  a bond tensor without breaks
  /// @throws NumericalError  the equations are not solved
  method::StripState solve_strip(const method::RiceStrip &strip, const physics::Kernel<2> &kernel,
                                 const AxisShapes &shapes);
} // namespace plumbline::reference
