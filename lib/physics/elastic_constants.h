#pragma once

namespace plumbline::physics
{
  /// What stands for the third dimension where a problem has two.
  enum class ElasticState
  {
    plane_stress,
    plane_strain,
    solid ///< three dimensions
  };

  /// Stiffness of a medium of cubic symmetry, axes along those of its lattice. A lattice in the
  /// plane has no more; an isotropic medium has C1111 - C1122 = 2 C1212.
  struct CubicStiffness
  {
    double C1111 = 0, C1122 = 0, C1212 = 0; ///< [force/area]
  };

  /// What engineers know of it.
  struct EngineeringConstants
  {
    double E = 0;            ///< Young's modulus along an axis [force/area]
    double nu = 0;           ///< Poisson's ratio of a bar along an axis
    double shear_along = 0;  ///< of planes along the axes: C1212 [force/area]
    double shear_across = 0; ///< of planes at 45 degrees to them: (C1111 - C1122) / 2 [force/area]
    double anisotropy = 0;   ///< Zener's ratio, the first over the second; 1: isotropic
  };

  /// @param state  of the plane that C1111, C1122 and C1212 are those of; plane strain and solids
  /// have the stiffness of the solid
  EngineeringConstants engineering_constants(const CubicStiffness &stiffness, ElasticState state);

  /// The bulk modulus that Kernel::with_bulk_modulus takes for a Young's modulus: bonds alone have
  /// λ = μ, so that ν = 1/3 in plane stress, where E = 8 μ/3, and 1/4 else, where E = 5 μ/2.
  /// @param E  [force/area]
  double bulk_modulus_of_bonds(double E, ElasticState state);
} // namespace plumbline::physics
