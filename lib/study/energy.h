#pragma once

#include "base/communicator.h"
#include "method/linear_equations.h"
#include "method/method.h"
#include "problem/in_space.h"
#include "problem/problem.h"
#include "scene/choices.h"
#include "study/study_results.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace plumbline::study
{
  // The bilinear form of a method's equations is a(u, v) = Σ_i w_i v_i (A u)_i over free nodes i:
  // for Galerkin methods w = 1, and of functions that are zero at constrained nodes it is
  // ½∬γ (u(x') - u(x)) (v(x') - v(x)); for a meshfree rule w are the volumes of the nodes, and it
  // is the rule's own form, that of its symmetric part where u = v.

  /// ½ a(u, u) of values at all nodes, constrained ones last, shape (n_nodes · n_components):
  /// ½ [Σ_i w_i u_i·(A u)_i + Σ_ij w_i (u_i - g_j)·A_ij g_j], j over constrained nodes. The first
  /// sum alone lacks what constrained nodes add; the second is from bonds between free and
  /// constrained nodes, -w_i A_ij, as A annihilates constants. Other terms of the constraint alone
  /// are omitted: for one constraint, differences of energies are those of ½ a(u, u), and
  /// constants have energy 0. For a zero constraint it is ½ Σ_i w_i u_i·(A u)_i.
  template <int dim>
  double energy(const method::LinearEquations<dim> &of, const std::vector<double> &values);

  /// √a(e, e) of values at free nodes, 0 at the others; nothing where a(e, e) is negative by more
  /// than round-off: the form is not positive definite.
  /// @param e  shape (n_free · n_components)
  template <int dim>
  std::optional<double> energy_norm(const method::LinearEquations<dim> &of,
                                    const std::vector<double> &e);

  /// Whether the norm "energy" is among these. It needs a whole solution on one rank, so that ranks
  /// do not share a problem with this norm.
  inline bool has_energy(const std::vector<scene::Norm> &norms)
  {
    return std::find(norms.begin(), norms.end(), scene::Norm::energy) != norms.end();
  }

  /// Where the norm "energy" is asked for, enter into the record of any method
  /// - "energy": ½ a(u_h, u_h), see above, and "energy of exact", "energy of local": of the known
  ///   solutions at the method's own nodes, with the problem's constraint around them;
  /// - "energy | exact", "energy | local": √a(e, e), e the nodal error, so that of Galerkin methods
  ///   it is ‖u_h - I_h u‖ with the interpolant I_h u, not with u itself. Nothing, and a note,
  ///   where the form is not positive definite;
  /// - "energy size", to which these are relative: √(2 energy); where that is not positive, the
  ///   bound below times the variation of the solution. "largest energy norm": √(Σ w_i |a_ij|),
  ///   which bounds √a(e, e) / max|e|.
  /// The equations are assembled again. For bodies with a free boundary, whose rules have no sparse
  /// matrix, the operator is applied instead.
  /// @param nodes  the free ones
  /// @param nodal  u_h there, shape (n_free, n_components)
  /// @param ranks  that share nodal values; the norm is for one
  /// @throws InputError  as equations_of; more than one rank
  template <int dim>
  void enter_energies(const method::Method &method, const std::vector<scene::Norm> &norms,
                      const problem::Problem<dim> &problem,
                      const std::vector<dealii::Point<dim>> &nodes,
                      const std::vector<double> &nodal, Record &record,
                      const base::Communicator &ranks = base::Communicator::alone());
} // namespace plumbline::study
