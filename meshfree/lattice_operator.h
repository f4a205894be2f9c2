#pragma once

#include "algebra/stencil.h"
#include "meshfree/bonds.h"

namespace plumbline::meshfree
{
  /// The rule's operator L_h on a lattice: row i is -Σ C(kernel_point) (u(x_i + ξ) - u_i)
  /// weight.
  algebra::Stencil lattice_operator(const physics::Kernel<2> &kernel, const Bonds &bonds);
} // namespace plumbline::meshfree
