#pragma once

#include "reference/lattice_field.h"
#include "study/method.h"

namespace plumbline::reference
{
  /// Q1, Q2, Q3 (continuous) and DGQ0, DGQ1, DGQ2 (discontinuous) on the scene's lattice.
  study::Methods lattice_methods();

  /// A lattice Galerkin solution with what led to it, for tests and benchmarks.
  struct LatticeSolution
  {
    LatticeField field;
    geometry::NodeSet nodes;
    base::Cost cost;
    study::Diagnostics diagnostics;
  };

  /// Assemble and solve: exact entries, loads tested exactly where they are smooth, data of the
  /// collar interpolated at the support points.
  /// @throws NumericalError  the solver does not converge
  LatticeSolution solve_lattice(const scene::Scene &scene, const scene::Problem &problem,
                                const AxisShapes &shapes);
} // namespace plumbline::reference
