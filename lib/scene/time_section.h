#pragma once

#include <string>
#include <vector>

namespace plumbline::scene
{
  class Keys;

  /// What the section Time of a scene file says: ρ ü = F(u) + b - η ρ u̇ from t = 0 on, see
  /// problem_sections.h.
  struct TimeSection
  {
    double final_time = 0; ///< 0: static [time]
    std::vector<std::string> schemes = {"velocity Verlet"};
    std::vector<double> steps;         ///< Δt; empty: fractions [time]
    std::vector<double> fractions{.5}; ///< of the critical step, where no steps are given
    double density = 1;                ///< ρ > 0
    double damping = 0;                ///< η >= 0 [1/time]
    std::string initial_displacement;  ///< an expression; empty: the solution at t = 0
    std::string initial_velocity;      ///< an expression; empty: the solution's rate at t = 0
    bool shows_blow_up = false;        ///< steps beyond the critical one are taken
    bool is_lumped = false;            ///< masses of Galerkin methods
    bool has_bounds = false;           ///< a priori bounds beside errors, of double wells
    double hoelder_exponent = 1;       ///< γ in (0, 1] of these bounds
    unsigned int n_frames = 0;         ///< of the motion, as VTU and PVD

    bool is_dynamic() const { return final_time != 0; }

    void declare(Keys &keys);
    /// @throws InputError  a number that is out of range
    void complete() const;
  };
} // namespace plumbline::scene
