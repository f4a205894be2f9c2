#pragma once

#include "physics/state_based.h"

namespace plumbline::physics
{
  /// Bounds on the Lamé constants of a solid.
  struct LameBounds
  {
    Lame least, largest;

    /// Extends the bounds to include these constants.
    void add(const Lame &one);
  };

  /// Assumption 1 of Fan et al. 2022, doi:10.1016/j.cma.2022.115340: there are A0, A1 > 0 with
  ///   (4 - A1) μ0 - A0 (λ∞ - λ0) > 0 and λ∞ - (λ∞ - λ0)/(2 A0) - μ∞/(2 A1) >= 0,
  /// for which theorem 1 proves that the linear peridynamic solid of the plane is well posed. The
  /// best A0 for an A1 is its upper bound (4 - A1) μ0 / (λ∞ - λ0); what is then taken from λ∞,
  /// p/(4 - A1) + q/A1 with p = (λ∞ - λ0)²/(2 μ0) and q = μ∞/2, is least where A1 = 4 √q/(√p + √q),
  /// (√p + √q)²/4. So the assumption is 8 λ∞ > (√μ∞ + (λ∞ - λ0)/√μ0)².
  struct Assumption1
  {
    double left = 0, right = 0; ///< 8 λ∞, and what it must exceed [force/length^2]

    bool holds() const { return left > right; }
  };
  /// @pre of `least` both > 0
  Assumption1 assumption_1(const LameBounds &bounds);
} // namespace plumbline::physics
