#pragma once

#include "meshfree/rules/families.h"
#include "method/equation_of_motion.h"

namespace plumbline::meshfree
{
  /// Double wells on scattered nodes by a rule's families (see WellBond), each node with the mass
  /// of its cell V; u is given at the nodes of the collar. States are √V u, shape (2, n_free).
  /// Forces are those of the rule, node by node. Where a bond has the same weight from both ends
  /// (times the cells) they are the slope of the energy; where it has two, the energy and the
  /// tangent are those of their mean, and the rest disturbs the balance of energies.
  /// Accuracy: 1e-14 of Σ |bond forces|. The same bits for any number of threads.
  /// Not for: calling one object from several threads at a time.
  /// @throws NumericalError  a family that cannot be made
  /// @pre problem.double_well, problem.cells(), whose cells the families are made of
  std::unique_ptr<method::EquationOfMotion> move_double_well(const problem::Problem<2> &problem,
                                                             const Families<2> &families);
} // namespace plumbline::meshfree
