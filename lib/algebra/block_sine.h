#pragma once

#include "algebra/rectangle_solver.h"
#include "geometry/cube_families.h"

namespace plumbline::algebra
{
  /// The τ preconditioner for several families of nodes on a box of cells in space. Fields that are
  /// odd about all sides of the box are sums of waves: sines at vertices and for families that are
  /// even about the middle of the cell, cosines for odd ones. Two families that mirror each other
  /// are first rotated into an even and an odd one. On such fields a stencil that is even about
  /// each axis is a real symmetric matrix of the families for each wave; these are inverted.
  /// Components are treated one by one.
  /// @param box  of these cells
  /// @throws NumericalError  a matrix is not positive definite: the stencil is not coercive
  std::unique_ptr<RectangleSolver> make_block_sine_solver(const Stencil &stencil,
                                                          const geometry::CubeFamilies &nodes,
                                                          const geometry::CubeRange &box);
} // namespace plumbline::algebra
