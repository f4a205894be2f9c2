#pragma once

#include "algebra/stencil.h"
#include "method/diagnostics.h"
#include "problem/in_space.h"
#include "problem/problem.h"

// What is known of a method's limit without solving for any field. A field may hide what is wrong:
// a harmonic one has no second moment to miss.
namespace plumbline::method
{
  /// The operator of the nodes of a lattice, all alike: L_h u_a(0) = Σ_k A_ab(k) u_b(k h) / mass.
  /// Where Σ A = Σ A k = 0 and -½ Σ A_ab k_c k_d h² / mass is the local operator's tensor T_abcd
  /// (L u_a → -T_abcd ∂_c ∂_d u_b), L_h u tends to it for every smooth u as h → 0 at a fixed reach
  /// in cells, and only then: Taylor's formula, with the remainder O(h²). Stability is the solver's
  /// to show, which refuses stencils that are not positive definite.
  /// In space, in the plane and on a line.
  /// @param mass  1 for equations at nodes, h^dim for tested ones [1 or length^dim]
  /// @pre  stencil.n_blocks() == problem.n_components: one family of nodes
  template <int dim>
  LimitProof prove_by_moments(const problem::Problem<dim> &problem, const algebra::Stencil &stencil,
                              double mass);

  /// What the moments of the families of scattered nodes say of this problem. They are those of the
  /// kernel alone. A material a(x, y) = mean(a(x), a(y)) changes the local limit to -∇·(a T ∇u) but
  /// not the conditions on moments: a(x, x + ξ) = a + ∇a·ξ/2 + O(ξ²), so that second moments
  /// multiply both a ∂²u and ∇a·∇u. Wrong ones are wrong for every a; right ones prove the limit
  /// where a is smooth, since bond coefficients keep their signs. Broken bonds: wrong moments of
  /// whole families are kept, for a method with them is not to be advised, but prove nothing.
  LimitProof limit_of(const problem::Problem<2> &problem, const LimitProof &of_families);

  /// The same in space, where nothing is broken. Nothing is said of bodies with free surfaces,
  /// whose families are truncated.
  LimitProof limit_of(const problem::Problem<3> &problem, const LimitProof &of_families);

  /// A conforming Galerkin method of degree 1 or more. Its space holds the continuous piecewise
  /// linear (on quadrilaterals bilinear) functions, which are dense in the local energy space
  /// whatever the horizon, so it is asymptotically compatible where the kernel is >= 0, does not
  /// increase with distance and the material is homogeneous (Tian & Du 2014, SIAM J. Numer. Anal.
  /// 52, doi:10.1137/130942644: scalar diffusion, bond-based and state-based solids). A coefficient
  /// of the bonds with 0 < a_min <= a <= a_max makes energies equivalent to homogeneous ones,
  /// uniformly in the horizon, so that their abstract framework covers it where L u tends to the
  /// local operator's value for smooth u, that is for smooth a. Integrable kernels, all that a
  /// scene can have, make discontinuous spaces conforming too. Unknown elsewhere: for other
  /// coefficients, state-based solids that vary, free bodies, and entries by quadrature of unknown
  /// error.
  LimitProof prove_galerkin(const problem::Problem<2> &problem, const Diagnostics &diagnostics);

  /// The same on a box in space, whose entries are exact and whose material is homogeneous.
  LimitProof prove_galerkin(const problem::Problem<3> &problem);

  /// The same on intervals. Kernels like 1/r, which are not integrable on a line, keep
  /// discontinuous spaces conforming: the energy of a jump, 2 ∫ r C dr, is finite.
  LimitProof prove_galerkin(const problem::Problem<1> &problem);
} // namespace plumbline::method
