#pragma once

#include "reference/shapes.h"
#include "study/method.h"

namespace plumbline::reference
{
  /// The mass matrix ∫ φ_s φ_t of a lattice's shape functions as a stencil, exact. Blocks as in
  /// geometry::NodeSet, entries [length^2].
  algebra::Stencil mass_stencil(const AxisShapes &shapes, unsigned int n_components, double h);

  /// Of the matrix that `solve_lattice` solves with, and the consistent mass matrix.
  study::SymbolData lattice_symbol(const scene::Scene &scene, const scene::Problem &problem,
                                   const AxisShapes &shapes);
} // namespace plumbline::reference
