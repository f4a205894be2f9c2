#pragma once

#include "method/equation_of_motion.h"

namespace plumbline::reference
{
  /// Double wells on a square torus or a line that closes, without a mesh, see TorusForce: states
  /// are values at n × n points, shape (2, n, n), or at n, and trigonometric polynomials between
  /// them.
  /// @pre scene.domain.is_periodic, a scene of double wells, one box with equal sides
  std::unique_ptr<method::ContinuousMotion> move_on_torus(const scene::Scene &scene, double horizon,
                                                          unsigned int n);
} // namespace plumbline::reference
