#include "physics/elastic_constants.h"

namespace plumbline::physics
{
  EngineeringConstants engineering_constants(const CubicStiffness &stiffness, ElasticState state)
  {
    const auto [C1111, C1122, C1212] = stiffness;
    EngineeringConstants result;
    if (state == ElasticState::plane_stress)
    {
      result.nu = C1122 / C1111;
      result.E = C1111 - C1122 * result.nu;
    }
    else
    {
      result.nu = C1122 / (C1111 + C1122);
      result.E = C1111 - 2 * C1122 * result.nu;
    }
    result.shear_along = C1212;
    result.shear_across = (C1111 - C1122) / 2;
    result.anisotropy = result.shear_along / result.shear_across;
    return result;
  }

  double bulk_modulus_of_bonds(double E, ElasticState state)
  {
    const double mu = state == ElasticState::plane_stress ? 3 * E / 8 : 2 * E / 5;
    return 5 * mu / 3; // λ = μ = 3κ/5
  }
} // namespace plumbline::physics
