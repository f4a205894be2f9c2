#pragma once

#include "physics/state_based.h"

namespace plumbline::physics
{
  /// Energy per length, or area in space, of all bonds across a straight cut of a continuum, for
  /// the stretch 1 of all bonds and the dilatation dim: ∫∫ (dim λ + 2μ) K r² over the bonds, of the
  /// influence function K = 3/(πδ³r) in the plane and 3/(πδ⁴r) in space. That is 4β (λ + μ) with β
  /// = ∫K r⁴ dr = 3δ/(4π), and πβ (3λ + 2μ) with β = ∫K r⁵ dr = 3δ/(5π). A bond breaks at the
  /// stretch s0 at which they hold G: s0² = G / crossing_energy. Instantiated for dim = 2 and 3.
  /// Source: Fan et al. 2022, doi:10.1016/j.cma.2022.115340, eqs. (2.24)-(2.26); Silling & Askari
  /// 2005, doi:10.1016/j.compstruc.2004.11.026, for λ = μ.
  /// @return [force/length]
  template <int dim>
  double crossing_energy(double horizon, const Lame &lame);
} // namespace plumbline::physics
