#pragma once

#include "geometry/cube_lattice.h"
#include "geometry/lattice.h"

#include <type_traits>

// What the plane and space have in common, by the number of dimensions.
namespace plumbline::geometry
{
  template <int dim>
  using BoxOf = std::conditional_t<dim == 2, Box, Cuboid>;

  /// A union of boxes, minus other boxes.
  template <int dim>
  using RegionOf = std::conditional_t<dim == 2, Domain, Solid>;

  template <int dim>
  using LatticeOf = std::conditional_t<dim == 2, Lattice, CubeLattice>;
} // namespace plumbline::geometry
