#pragma once

#include "method/method.h"

namespace plumbline::reference
{
  /// Galerkin methods: continuous Q1 to Q3 and discontinuous DGQ0 to DGQ3 on lattices (exact
  /// entries, one stencil) and on meshes of quadrilaterals, P1 to P3 and DGP0 to DGP3 on meshes of
  /// triangles; LOCAL, classical finite elements for the local limit, on meshes; and Q1+polygon8 to
  /// Q1+polygon32, with polygons in place of balls.
  method::Methods methods();
} // namespace plumbline::reference
