#pragma once

#include "algebra/stencil.h"
#include "method/diagnostics.h"
#include "scene/problem.h"

// What is known of a method's limit without solving for any field. A field may hide what is wrong:
// a harmonic one has no second moment to miss.
namespace plumbline::method
{
  /// The operator of the nodes of a lattice, all alike: L_h u_a(0) = Σ_k A_ab(k) u_b(k h) / mass.
  /// Where Σ A = Σ A k = 0 and -½ Σ A_ab k_c k_d h² / mass is the local operator's tensor T_abcd
  /// (L u_a → -T_abcd ∂_c ∂_d u_b), L_h u tends to it for every smooth u as h → 0 at a fixed reach
  /// in cells, and only then: Taylor's formula, with the remainder O(h²). Stability is the solver's
  /// to show, which refuses stencils that are not positive definite.
  /// @param mass  1 for equations at nodes, h² for tested ones [1 or length^2]
  /// @pre  stencil.n_blocks() == problem.n_components: one family of nodes
  LimitProof prove_by_moments(const scene::Problem &problem, const algebra::Stencil &stencil,
                              double mass);

  /// A conforming Galerkin method of degree 1 or more. Its space holds the continuous piecewise
  /// linear (on quadrilaterals bilinear) functions, which are dense in the local energy space
  /// whatever the horizon, so it is asymptotically compatible where the kernel is >= 0, does not
  /// increase with distance and the material is homogeneous (Tian & Du 2014, SIAM J. Numer. Anal.
  /// 52, doi:10.1137/130942644: scalar diffusion, bond-based and state-based solids). Integrable
  /// kernels, all that a scene can have, make discontinuous spaces conforming too. Unknown
  /// elsewhere: for coefficients that vary, free bodies, and entries by quadrature of unknown
  /// error.
  LimitProof prove_galerkin(const scene::Problem &problem, const Diagnostics &diagnostics);
} // namespace plumbline::method
