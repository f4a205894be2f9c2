#pragma once

#include "physics/kernel.h"

#include <string>

namespace plumbline::benchmarks
{
  /// A scalar kernel that tends to -1/2 Laplace.
  inline physics::Kernel<2> make_kernel(const std::string &type, double horizon)
  {
    return physics::Kernel<2>::with_diffusion(physics::kernel_type(type).profile, horizon, .5);
  }

  void register_operators();  ///< applications, by every backend
  void register_families();   ///< ball ∩ cell, rules on lattices and on scattered nodes
  void register_forces();     ///< of bonds with two wells
  void register_assembly();   ///< Galerkin entries: lattices, pairs of cells, whole meshes
  void register_tetrahedra(); ///< the same on tetrahedra, exact ones and those of quadrature
} // namespace plumbline::benchmarks
