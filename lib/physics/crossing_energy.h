#pragma once

#include "physics/state_based.h"

namespace plumbline::physics
{
  /// Energy per length, or area in space, of all bonds across a straight cut of a continuum, for
  /// the stretch 1 of all bonds and the dilatation dim. A bond of the strain energy density (dim λ
  /// + 2μ) K r²/2 at each of its ends crosses a line of normal n |ξ·n| times in a unit of its
  /// length, each of ±ξ once: (dim λ + 2μ)/2 ∫ K r² |ξ·n| dξ, that is 4β (λ + μ) with β = ∫K r⁴ dr
  /// in the plane, and πβ (3λ + 2μ) with β = ∫K r⁵ dr in space. K = 3/(πδ³r) has β = 3δ/(4π), and K
  /// = 3/(πδ⁴r) in space β = 3δ/(5π). A bond breaks at the stretch s0 at which they hold G: s0² = G
  /// / crossing_energy. The dilatation is an approximation: exact where λ = μ. Exact for profiles
  /// that are powers or tables, to round-off for functions. Instantiated for dim = 2 and 3. Source:
  /// Fan et al. 2022, doi:10.1016/j.cma.2022.115340, eqs. (2.24)-(2.26), of 1/r; Silling & Askari
  /// 2005, doi:10.1016/j.compstruc.2004.11.026, and Ha & Bobaru 2010,
  /// doi:10.1007/s10704-010-9442-4, for λ = μ.
  /// @param influence  ∫K|ξ|² = dim
  /// @return [force/length]
  template <int dim>
  double crossing_energy(const Kernel<dim> &influence, const Lame &lame);
} // namespace plumbline::physics
