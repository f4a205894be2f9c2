#pragma once

#include "reference/lattice/field.h"
#include "study/method.h"

namespace plumbline::reference
{
  /// A lattice Galerkin solution with what led to it, for tests and benchmarks.
  struct LatticeSolution
  {
    LatticeField field;
    geometry::NodeSet nodes;
    base::Cost cost;
    study::Diagnostics diagnostics;
  };

  /// Assemble and solve: exact entries, the dilatation's part among them, loads tested exactly
  /// where they are smooth, data of the collar interpolated at the support points.
  /// @throws NumericalError  the solver does not converge
  LatticeSolution solve_lattice(const scene::Scene &scene, const scene::Problem &problem,
                                const AxisShapes &shapes);

  /// The same, as the study compares it, with the geometry checked on a sample of cut cells.
  study::Solution lattice_solution(const scene::Scene &scene, const scene::Problem &problem,
                                   const AxisShapes &shapes);

  /// The operator that these solve with. Masses by the diagonal of the mass matrix, scaled to the
  /// area of each cell: Hinton, Rock & Zienkiewicz 1976, doi:10.1002/eqe.4290040305.
  study::DiscreteOperator lattice_discrete(const scene::Scene &scene, const scene::Problem &problem,
                                           const AxisShapes &shapes);
} // namespace plumbline::reference
