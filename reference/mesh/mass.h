#pragma once

#include "algebra/csr_matrix.h"
#include "reference/mesh/cell_rules.h"

namespace plumbline::reference
{
  /// ∫_Ω φ_i φ_j of the free unknowns by all unknowns, components interleaved. Exact on triangles
  /// and parallelograms.
  algebra::CsrMatrix mass_rows(const MeshSpace &space, const MeshCells &cells,
                               unsigned int n_components);

  /// The diagonal of the mass matrix of free dofs, scaled to the area of each cell.
  std::vector<double> lumped_masses(const MeshSpace &space, const MeshCells &cells);
} // namespace plumbline::reference
