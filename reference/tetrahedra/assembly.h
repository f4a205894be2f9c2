#pragma once

#include "algebra/csr_matrix.h"
#include "physics/kernel.h"
#include "reference/tetrahedra/space.h"

namespace plumbline::reference
{
  /// Rows ½∬C(x - y) (φ_i(x) - φ_i(y)) (φ_j(x) - φ_j(y)) of unknowns i = 0 ... n_rows - 1 by all
  /// unknowns j, in the units of the kernel, by the faces of cells: see FacePotential. Integrals
  /// over pairs of faces are by quadrature, all else is exact, so that rows annihilate constants,
  /// and those of continuous functions linear fields, to round-off.
  /// @param refinement  of the quadrature, see FacePairs
  /// @pre  rows of unknowns whose supports are a horizon or more from the outside of the mesh; a
  /// kernel that FacePotential takes
  algebra::CsrMatrix assemble_by_faces(const TetrahedralSpace &space,
                                       const physics::Kernel<3> &kernel, std::size_t n_rows,
                                       unsigned int refinement);

  /// The largest difference of two entries in rows that both have, relative to the largest entry
  /// there.
  double difference(const algebra::CsrMatrix &a, const algebra::CsrMatrix &b);
} // namespace plumbline::reference
