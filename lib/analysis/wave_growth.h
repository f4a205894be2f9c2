#pragma once

#include "analysis/transient.h"

#include <array>

namespace plumbline::analysis
{
  /// What becomes of a small standing wave cos(k·x) about a state of equilibrium.
  struct WaveGrowth
  {
    double linear = 0; ///< √λ, λ > 0 the largest eigenvalue of its tangent over density; else 0
    double observed = 0; ///< the rate at which the motion itself lets it grow; 0: it does not
  };

  /// Start the most unstable polarisation at rest with 1e-10 of a length and move it, by velocity
  /// Verlet, until it has grown by e^12, or through two periods where it only swings; what is
  /// observed is its logarithm's slope over the second half.
  /// Accuracy: 1e-3 of the rate: Δt, of a twentieth of the critical one, and what is nonlinear in
  /// strains up to 2e-5. A rate below 1 / (50 longest_time) is not seen.
  /// @param transient     of the equation, with what holds the equilibrium
  /// @param about         its u
  /// @param wave          k, of the torus
  /// @param length        what strains are measured by: the horizon
  /// @param longest_time  of the motion
  /// @throws NumericalError  a motion that is not finite any more
  /// @pre two components, every node alike: a torus
  WaveGrowth observe_growth(const method::EquationOfMotion &equation, const Transient &transient,
                            const Vector &about, const std::array<double, 2> &wave, double length,
                            double longest_time);
} // namespace plumbline::analysis
