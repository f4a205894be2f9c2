#pragma once

#include "algebra/stencil.h"
#include "meshfree/rules/bonds.h"
#include "method/diagnostics.h"
#include "physics/state_based.h"
#include "problem/in_space.h"

namespace plumbline::meshfree
{
  /// The rule's operator L_h on a lattice: row i is -Σ C(kernel_point) (u(x_i + ξ) - u_i)
  /// weight. Instantiated for dim = 1, 2 and 3.
  template <int dim>
  algebra::Stencil lattice_operator(const physics::Kernel<dim> &kernel, const Bonds<dim> &bonds);

  /// The same of a homogeneous state-based solid, θ eliminated: with g_k = w_k K(q_k) ξ_k, q the
  /// kernel point, and Σ g = 0 by symmetry, θ_i = Σ_k g_k·u_{i+k} adds -(λ - μ) Σ_k,l g_k ⊗ g_l
  /// u_{i+k+l} to the bonds: twice their reach. Weights that give the tensor moments
  /// Σ w μ K ξ⊗ξ/|ξ|² ξ^α exactly (OPT, IPA-AC-R2) give those of K, their trace, exactly as well,
  /// and so the dilatation. Instantiated for dim = 2 and 3.
  /// @param bonds  of its deviatoric kernel
  template <int dim>
  algebra::Stencil state_based_stencil(const physics::Dilatation<dim> &dilatation,
                                       const Bonds<dim> &bonds);

  /// Diagnostics of a rule's weights and of its limit. Instantiated for dim = 1, 2 and 3.
  /// @param stencil  its operator for the problem
  template <int dim>
  method::Diagnostics describe(const problem::Problem<dim> &problem, const Bonds<dim> &bonds,
                               const algebra::Stencil &stencil);
} // namespace plumbline::meshfree
