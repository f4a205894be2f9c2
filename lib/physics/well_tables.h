#pragma once

#include "physics/piecewise_polynomial.h"

namespace plumbline::physics
{
  /// What forces evaluate of a WellPotential that is not exponential.
  struct WellTables
  {
    PiecewisePolynomial mean_slope; ///< φ(s)/s
    PiecewisePolynomial derivative; ///< φ'
    PiecewisePolynomial tangent;    ///< φ' + 2sφ''
  };
} // namespace plumbline::physics
