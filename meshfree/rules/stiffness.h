#pragma once

#include "meshfree/rules/bonds.h"
#include "physics/elastic_constants.h"

namespace plumbline::meshfree
{
  /// The stiffness of what L_h is on smooth displacements, -½ Σ w C_ab ξ_c ξ_d ∂_c ∂_d u_b: the
  /// moments ½ Σ w C_11 ξ_1² = C1111, ½ Σ w C_11 ξ_2² = C1212 and Σ w C_12 ξ_1 ξ_2 = C1122 +
  /// C1212. Waves of long wavelength and homogeneous strains know nothing else of a rule.
  /// @param kernel  a tensor
  /// @throws InputError  a scalar kernel, which has no stiffness
  template <int dim>
  physics::CubicStiffness stiffness(const Kernel<dim> &kernel, const Bonds<dim> &bonds);
} // namespace plumbline::meshfree
