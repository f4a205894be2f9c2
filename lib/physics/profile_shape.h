#pragma once

#include "physics/radial_profile.h"

namespace plumbline::physics
{
  /// The least value of a profile.
  struct LeastValue
  {
    double t = 0, value = 0;
    double rounding = 0; ///< of the terms that make it
  };

  /// Of t^-a ρ over [0, 1], where t^a is its lowest power; it has the sign of ρ, and is ρ where
  /// that is bounded. Exact for powers and tables, which are polynomials between their breaks: at
  /// their ends and where the derivative vanishes. Functions: at 2048 points of each smooth piece,
  /// sixteen for each that resolves it.
  LeastValue least_value(const RadialProfile &profile);

  /// Whether `sign` ρ >= 0 and does not increase on (0, 1], to the rounding of its terms. As exact.
  bool is_positive_and_non_increasing(const RadialProfile &profile, double sign);
} // namespace plumbline::physics
