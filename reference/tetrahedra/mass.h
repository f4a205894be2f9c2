#pragma once

#include "algebra/csr_matrix.h"
#include "reference/tetrahedra/space.h"

namespace plumbline::reference
{
  /// ∫ φ_i φ_j of the free unknowns by all unknowns, components interleaved. Exact on tetrahedra
  /// and, of trilinear functions, on parallelepipeds.
  algebra::CsrMatrix mass_rows(const TetrahedralSpace &space, unsigned int n_components);
} // namespace plumbline::reference
