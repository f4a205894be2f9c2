#pragma once

#include "analysis/motion.h"
#include "analysis/schemes.h"

#include <cstdint>
#include <optional>

namespace plumbline::analysis
{
  struct Stepping
  {
    double step = 0; ///< Δt > 0; shortened a little so that a whole number of steps ends on time
    /// Longer steps of explicit schemes are refused, unless a blow-up is to be seen.
    std::optional<double> critical_step = {};
    bool shows_blow_up = false;
    /// Of Newton's residual, relative to ‖u‖ + Δt ‖v‖, and of Runge-Kutta's steps.
    double tolerance = 1e-12;
  };

  /// Number of steps of a scheme with equal steps: the fewest that are no longer than `step`, up to
  /// rounding, and end exactly at `time`. 0 if time = 0.
  std::uint64_t n_equal_steps(double time, double step);

  struct Counts
  {
    std::uint64_t n_steps = 0, n_accelerations = 0, n_tangents = 0, n_newton = 0;
  };

  /// Called after each step; of Runge-Kutta at the multiples of Δt.
  using Observer = std::function<void(const State &)>;

  /// Move a state to a later time. Every scheme shows its order with damping, too.
  /// @throws InputError      a step that is not positive or longer than the critical one, a state
  ///                         that is not finite or of another size, damping < 0, a time before
  ///                         state.t, an implicit scheme without a tangent
  /// @throws NumericalError  values that are not finite any more; an implicit step whose matrix
  ///                         I - Δt²θ² ∂a/∂u is not positive definite (growth faster than 1/(θΔt),
  ///                         named with the step that it allows), or that does not settle
  Counts integrate(const Motion &motion, const Scheme &scheme, const Stepping &stepping, double end,
                   State &state, const Observer &observer = {});
} // namespace plumbline::analysis
