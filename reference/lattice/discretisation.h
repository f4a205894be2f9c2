#pragma once

#include "method/box_discretisation.h"
#include "method/method.h"
#include "reference/shapes.h"

namespace plumbline::reference
{
  /// Exact entries, the dilatation's part among them, in one stencil; loads tested exactly where
  /// they are smooth, data of the collar interpolated at the support points, the geometry checked
  /// on a sample of cut cells. Masses by the diagonal of the mass matrix, scaled to the area of
  /// each cell: Hinton, Rock & Zienkiewicz 1976, doi:10.1002/eqe.4290040305.
  /// @param n_sides  of the polygon that replaces the ball, see polygonal_ball.h; 0: the ball
  std::unique_ptr<method::Discretisation> discretise_on_lattice(const problem::Problem<2> &problem,
                                                                const AxisShapes &shapes,
                                                                unsigned int n_sides = 0);

  /// On a box in space.
  /// @pre shapes of one family: continuous ones of degree 1, or constants
  /// @throws NumericalError  no vertex is free
  std::unique_ptr<method::BoxDiscretisation> discretise_on_box(const problem::Problem<3> &problem,
                                                               const AxisShapes &shapes);

  /// On a box in space, for all shapes: free are those whose support lies in Ω.
  std::unique_ptr<method::DiscretisationInSpace>
  discretise_by_families(const problem::Problem<3> &problem, const AxisShapes &shapes);

  /// With one axis: motions of double wells.
  /// @pre shapes are continuous
  std::unique_ptr<method::Discretisation> discretise_on_line(const problem::Problem<2> &problem,
                                                             const AxisShapes &shapes);
} // namespace plumbline::reference
