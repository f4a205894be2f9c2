#pragma once

#include "algebra/csr_matrix.h"
#include "geometry/visibility.h"
#include "physics/coefficient.h"
#include "physics/kernel.h"
#include "reference/mesh/cells.h"
#include "reference/mesh/space.h"

#include <optional>

namespace plumbline::reference
{
  struct AssemblyOptions
  {
    unsigned int refinement =
        0;                     ///< of the outer rule where the circle crosses a cell: 4^refinement
    bool exact_entries = true; ///< where an exact way is known, else by quadrature
    geometry::Backend backend = geometry::Backend::fast;
    std::vector<geometry::Cut> cracks = {}; ///< that no bond crosses: pairs past them by quadrature
  };

  /// The Galerkin matrix of a space and how it came about.
  struct MeshMatrix
  {
    /// Rows of the free unknowns, columns of all: unknown = dof · n_components + component;
    /// shape (n_free n_components, n_dofs n_components). On several ranks the sum of all is the
    /// matrix.
    algebra::CsrMatrix rows;
    bool is_exact = true; ///< no outer quadrature: no error but rounding
    std::string way;      ///< how the entries came, in words
  };

  /// Whether assemble takes the exact entries of pairs of sides of all of the mesh.
  bool goes_by_edges(const MeshSpace &space, const MeshCells &cells,
                     const physics::Kernel<2> &kernel,
                     const std::optional<physics::Coefficient> &coefficient);

  /// A(u, v) = ½ ∬ a C (u(y) - u(x)) · (v(y) - v(x)) over all pairs of points of Ω and its collar
  /// but those with both ends in the collar; a the mean of the coefficients, C the kernel. Each
  /// unordered pair of cells is visited once, outer points on the smaller of the two; threads share
  /// the cells (results do not depend on their number), ranks of the communicator too. Memory:
  /// three times the matrix, and 4 bytes for each cell in the reach of each.
  /// @throws InputError  a coefficient that is not positive
  MeshMatrix assemble(const MeshSpace &space, const MeshCells &cells,
                      const physics::Kernel<2> &kernel,
                      const std::optional<physics::Coefficient> &coefficient,
                      const AssemblyOptions &options, const base::Communicator &communicator);
} // namespace plumbline::reference
