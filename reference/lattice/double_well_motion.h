#pragma once

#include "method/equation_of_motion.h"
#include "reference/shapes.h"

namespace plumbline::reference
{
  /// Double wells by continuous elements on a torus of one axis or two, see DoubleWellGalerkin,
  /// with its mass matrix or lumped: states are M^½ u of the nodal values u, in which tangents are
  /// symmetric. Loads are tested by degree + 2 Gauss points a side of a cell.
  /// @param n_more  Gauss points of forces beyond those that are enough, to see that they are
  /// @param largest_eigenvalue  of the stencil of small strains and the same mass, for steps;
  /// empty: who needs it finds it by the tangent
  /// @pre shapes are continuous, problem.is_periodic(), problem.double_well, problem.lattice()
  std::unique_ptr<method::EquationOfMotion>
  move_galerkin_on_torus(const problem::Problem<2> &problem, const AxisShapes &shapes,
                         bool is_lumped, std::optional<double> largest_eigenvalue,
                         unsigned int n_more = 0);
} // namespace plumbline::reference
