#pragma once

#include "meshfree/rules/bonds.h"
#include "method/equation_of_motion.h"

namespace plumbline::meshfree
{
  /// Double wells on a lattice by a rule's bonds: on a torus, or with u given at all nodes that are
  /// not free within reach, where ω may vanish. Forces, tangents and energies are those of
  /// DoubleWellForce.
  /// @param largest_eigenvalue  of the rule's stencil of small strains on the unbounded lattice,
  /// which is that of a torus, and bounds that of other boxes from above
  /// @param gradient  G of a torus: states are G x and what is periodic
  /// @throws NumericalError  weights that differ between mirror images
  /// @pre problem.double_well, problem.lattice(); a torus where G is not 0
  std::unique_ptr<method::EquationOfMotion>
  move_double_well(const problem::Problem<2> &problem, const Bonds<2> &bonds,
                   double largest_eigenvalue, const dealii::Tensor<2, 2> &gradient = {});

  /// The same on the torus of one axis, by axis_bonds.
  /// @throws InputError  as axis_bonds
  /// @pre problem.dimension() == 1
  std::unique_ptr<method::EquationOfMotion>
  move_double_well_on_line(const problem::Problem<2> &problem, const std::string &rule);
} // namespace plumbline::meshfree
