#pragma once

#include "algebra/csr_matrix.h"
#include "reference/tetrahedra/space.h"

namespace plumbline::reference
{
  /// Consistent mass matrix ∫ φ_i φ_j: rows of the free unknowns, columns of all unknowns,
  /// components interleaved. Exact on tetrahedra, and for trilinear functions on parallelepipeds.
  algebra::CsrMatrix mass_rows(const TetrahedralSpace &space, unsigned int n_components);
} // namespace plumbline::reference
