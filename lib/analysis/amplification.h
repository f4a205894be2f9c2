#pragma once

#include "analysis/schemes.h"

namespace plumbline::analysis
{
  /// The spectral radius of one step of δ'' = λ δ: the largest growth factor of the amplitude.
  /// Beyond 1 it grows. For λ > 0 the motion itself grows by exp(√λ Δt); for implicit Euler it is
  /// (65) of Jha & Lipton 2018, doi:10.1137/17M1112236, |1 + √λΔt| / |1 - λΔt²| = 1 / |1 - √λΔt|,
  /// which exceeds 1 only for √λΔt < 2, not always, as the paper states.
  /// @param lambda  [1/time^2]
  /// @param step    Δt > 0 [time]
  /// @return infinite where an implicit step has no solution, θ²λΔt² = 1
  /// @pre !scheme.is_runge_kutta
  double spectral_radius(const Scheme &scheme, double lambda, double step);
} // namespace plumbline::analysis
