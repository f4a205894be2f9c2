#pragma once

#include "physics/double_well.h"

#include <cstdint>

// A priori bounds of the errors of one-step schemes for double wells of unit density without
// damping. Source: Jha & Lipton 2018, doi:10.1137/17M1112236.
namespace plumbline::physics
{
  /// Largest norms over time of the solution that enter C_t and C_s.
  struct SolutionNorms
  {
    /// ‖u_tt‖, ‖u_ttt‖, ‖u_tttt‖ in L².
    double second = 0, third = 0, fourth = 0;
    double holder = 0, holder_second = 0; ///< ‖u‖ and ‖u_tt‖ in C^(0,γ), γ in (0, 1]
  };

  /// 6 C̄/ε², the Lipschitz constant of F in L². Source: (41). The paper drops the 6 in (50),
  /// (51) and all that follows from them, such as (53). Infinite where C̄ is.
  double lipschitz_constant(const DoubleWell &law);

  /// (37): ½ (sup ‖u_tt‖ + sup ‖u_ttt‖).
  double c_t(const SolutionNorms &norms);

  /// (49), of θ = ½: (sup ‖u_ttt‖ + sup ‖u_tttt‖) / 12.
  double c_t_of_trapezoidal(const SolutionNorms &norms);

  /// (38): c^γ √|D| (ε² sup ‖u_tt‖ + 4 C̄ sup ‖u‖) in Hölder norms, c = √dim (printed for 2 and 3).
  /// @param measure  |D| [length^dim]
  double c_s(const DoubleWell &law, const SolutionNorms &norms, double exponent, double measure);

  /// T exp(T (1 + L)), the factor of the truncation error C_t Δt + C_s h^γ/ε² in (17) and (43);
  /// C₁ of section 6.
  double growth_factor(double lipschitz, double final_time);

  /// C₂ of section 6, for γ = 1 in three dimensions:
  /// C₁ (1 + √3 C̄ (1 + 1/ε) + 4 √3 C̄/ε²). Printed are C₁ = .0193 and C₂ = 7.976 of C̄ = 1.19,
  /// ε = 1/10 and 1.5 μs of T* = 718 μs; by these formulas they are .00930 and 7.89, or with T* =
  /// 1/1400 s .00943 and 7.99. C₂ as printed belongs to C₁ = .0094, so that the 1 in .0193 is a
  /// misprint.
  double section_six_factor(double c_bar, double horizon, double final_time);

  /// (52) over n steps, with its two terms summed in closed form: the largest ‖e(u)‖ + ‖e(v)‖ of
  /// the scheme θ whose truncation error is at most τ, from no error at t = 0. Its a, b are those
  /// of L = max(1, Lipschitz constant), which the paper assumes to be at least 1.
  /// Infinite unless θ L Δt < 1: (53) is Δt < ε²/C̄ there, without θ and the 6 of (41).
  double one_step_bound(double lipschitz, double theta, double step, std::uint64_t n_steps,
                        double truncation);

  /// The longest step of (53) as printed, ε²/C̄; 0 where C̄ is infinite.
  double printed_step_limit(const DoubleWell &law);

  /// The longest step at which one_step_bound holds, 1/(θ max(1, L)); infinite for θ = 0.
  double step_limit(const DoubleWell &law, double theta);

  /// (63): C = 4 C₁ J̄_½ √|D|, J̄_½ = 1/ω_dim ∫ J |ξ|^(-½) over the unit ball (74).
  double energy_constant(const DoubleWell &law, double measure);

  /// (58): (√E(0) + T C/ε^(3/2) + ∫ ‖b‖ dt)².
  double energy_bound(const DoubleWell &law, double measure, double energy, double final_time,
                      double impulse);
} // namespace plumbline::physics
