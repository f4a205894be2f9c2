#pragma once

#include "meshfree/rules/bonds.h"
#include "physics/elastic_constants.h"

namespace plumbline::meshfree
{
  /// The stiffness of what L_h is on smooth displacements, -½ Σ w C_ab ξ_c ξ_d ∂_c ∂_d u_b: the
  /// moments ½ Σ w C_aa ξ_a² = C1111, ½ Σ w C_aa ξ_b² = C1212 and Σ w C_ab ξ_a ξ_b = C1122 +
  /// C1212, a ≠ b, each the mean over the axes, which are alike on a lattice. Waves of long
  /// wavelength and homogeneous strains know nothing else of a rule.
  /// @param kernel  a tensor
  /// @throws InputError  a scalar kernel, which has no stiffness
  template <int dim>
  physics::CubicStiffness stiffness(const Kernel<dim> &kernel, const std::vector<Bond<dim>> &bonds);
} // namespace plumbline::meshfree
