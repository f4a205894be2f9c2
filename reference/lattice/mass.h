#pragma once

#include "algebra/stencil.h"
#include "reference/shapes.h"

namespace plumbline::reference
{
  /// The mass matrix ∫ φ_s φ_t of a lattice's shape functions as a stencil, exact. Blocks as in
  /// geometry::NodeSet, entries [length^dim]. Instantiated for dim = 2 and 3.
  template <int dim>
  algebra::Stencil mass_stencil(const AxisShapes &shapes, unsigned int n_components, double h);
} // namespace plumbline::reference
