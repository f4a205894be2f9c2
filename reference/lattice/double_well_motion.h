#pragma once

#include "method/equation_of_motion.h"

namespace plumbline::reference
{
  /// Double wells by Q1 on a torus, see DoubleWellGalerkin, with its mass matrix or lumped: states
  /// are M^½ u of the nodal values u, shape (2, n[1], n[0]), in which tangents are symmetric. Loads
  /// are tested by 3 × 3 Gauss points a cell.
  /// @param largest_eigenvalue  of the stencil of small strains and the same mass, for steps
  /// @pre problem.is_periodic, problem.double_well, problem.lattice
  std::unique_ptr<method::EquationOfMotion>
  move_q1_on_torus(const scene::Problem &problem, bool is_lumped, double largest_eigenvalue);
} // namespace plumbline::reference
