#pragma once

#include "analysis/integrate.h"

namespace plumbline::analysis
{
  /// One step of the θ schemes u⁺ = u + Δt (θ v⁺ + (1-θ) v), v⁺ = v + Δt (θ A⁺ + (1-θ) A) with
  /// A = a - η v, by Newton's method and conjugate gradients.
  /// @param a  a(u, t), in and out
  /// @throws NumericalError  see integrate
  void theta_step(const Motion &motion, double theta, double step, double tolerance, State &state,
                  Vector &a, Counts &counts);

  /// ARKODE's explicit Runge-Kutta methods with control of the step, to the tolerance.
  void runge_kutta(const Motion &motion, const Stepping &stepping, double end, State &state,
                   const Observer &observer, Counts &counts);
} // namespace plumbline::analysis
