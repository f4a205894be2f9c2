#pragma once

#include <string>
#include <vector>

namespace plumbline::analysis
{
  /// One part of a split step: u += coefficient Δt v and t with it, or the exact flow of
  /// v̇ = a - η v over coefficient Δt with a at the present u and t.
  struct Substep
  {
    bool is_kick = false;
    double coefficient = 0;
  };

  /// A row of the table of time-stepping schemes.
  struct Scheme
  {
    std::string name, help;
    int order = 1;
    std::vector<Substep> substeps = {}; ///< of split schemes
    double theta = 0;                   ///< of implicit ones, else 0
    bool is_runge_kutta = false;        ///< of ARKODE, with steps of its own
    bool is_explicit_euler = false;
    bool is_implicit() const { return theta > 0; }
  };

  /// explicit Euler, symplectic Euler, velocity Verlet, Blanes-Moan, trapezoidal, implicit Euler,
  /// Runge-Kutta.
  const std::vector<Scheme> &schemes();

  /// One of the table, or "theta T" with a number T in [0, 1]: (18)-(19) of Jha & Lipton 2018.
  /// @throws InputError  unknown name; the message lists the known ones
  const Scheme &scheme(const std::string &name);

  /// The largest z such that oscillators ü = -ω² u stay bounded at ωΔt <= z: 2 for symplectic Euler
  /// and velocity Verlet, infinite for implicit schemes with θ >= ½ and for Runge-Kutta, which
  /// chooses its steps, 0 for explicit Euler and θ < ½. To 1e-9.
  double stability_limit(const Scheme &scheme);
} // namespace plumbline::analysis
