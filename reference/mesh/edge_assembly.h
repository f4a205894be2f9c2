#pragma once

#include "algebra/csr_matrix.h"
#include "physics/kernel.h"
#include "reference/mesh/space.h"

#include <cstdint>
#include <string>

namespace plumbline::reference
{
  /// Why the matrix of a space and a kernel cannot be had by edges; empty: it can be.
  std::string refuse_edges(const MeshSpace &space, const physics::Kernel<2> &kernel);

  /// The Galerkin matrix of continuous piecewise linears on triangles, exact to rounding: as the
  /// normal derivatives of φ jump on sides e alone, by J(e),
  ///   ∬_{|x-y|<δ} C φ_i(x) φ_j(y) = Σ_{e,e'} J_i(e) J_j(e') ∬ Ψ(y - x) over e × e', Δ²Ψ = C,
  /// (Green's identity in x and in y), for which the potential may be cut off at the circle; Ψ has
  /// as many entries as C. ∬ C φ_i(x) φ_j(x) is the mass matrix times ∫C, the ball being in the
  /// mesh. Accuracy: linear fields of slope 1/δ are annihilated to 1e-13 of the diagonal from
  /// δ = 3 h to 8 h, h growing twofold, to 4e-13 below; beyond, to 2e-12 at 16 h, as terms of pairs
  /// within the horizon are larger than their sum by the fourth power of their distance, or of δ,
  /// over h. Profiles with breaks are a sum of several without. Symmetric to the last bit.
  /// Memory: 24 bytes an entry; on several ranks an entry of the rows of their nodes and of edges
  /// that they integrate, and those columns of rows within the horizon. Threads share the edges
  /// (the result does not depend on their number), ranks of the communicator too.
  /// @pre     refuse_edges is empty
  /// @param n_pairs  of edges that this rank has integrated, if asked for
  /// @return  as MeshMatrix::rows
  algebra::CsrMatrix assemble_by_edges(const MeshSpace &space, const physics::Kernel<2> &kernel,
                                       const base::Communicator &communicator,
                                       std::uint64_t *n_pairs = nullptr);
} // namespace plumbline::reference
