#pragma once

#include "geometry/lattice.h"
#include "method/equation_of_motion.h"
#include "physics/double_well.h"

namespace plumbline::reference
{
  /// Double wells on a square torus or a line that closes, without a mesh, see TorusForce: states
  /// are values at n × n points, shape (2, n, n), or at n, and trigonometric polynomials between
  /// them.
  /// @param torus      a square; of a line its first axis counts
  /// @param dimension  1 or 2
  std::unique_ptr<method::ContinuousMotion> move_on_torus(const physics::DoubleWell &law,
                                                          const geometry::Box &torus,
                                                          unsigned int dimension, unsigned int n);
} // namespace plumbline::reference
