#pragma once

#include "algebra/csr_matrix.h"
#include "physics/coefficient.h"
#include "physics/kernel.h"
#include "reference/mesh/cells.h"
#include "reference/mesh/space.h"

#include <optional>

namespace plumbline::reference
{
  /// How far entries of a Galerkin matrix are from those by another way.
  struct EntryCheck
  {
    unsigned int n_entries = 0, n_pairs = 0; ///< of cells, that make them
    double worst_difference = 0;             ///< in units of the largest diagonal entry
  };

  /// A sample of entries of shape functions that share no cell, each by the correlations of the
  /// pairs of cells that make it (see integrate_correlation), until so many pairs are done. Costs 2
  /// ms a pair of linear triangles.
  /// @param rows         free unknowns with free unknowns
  /// @param coefficient  constant in each cell
  /// @return  no entries where correlations do not serve: degrees beyond 2, cells that are no
  ///          triangles or parallelograms (constants: any convex ones)
  EntryCheck check_entries(const MeshSpace &space, const MeshCells &cells,
                           const physics::Kernel<2> &kernel,
                           const std::optional<physics::Coefficient> &coefficient,
                           const algebra::CsrMatrix &rows, unsigned int n_pairs, unsigned int seed);

  /// Of cells with straight sides.
  EntryCheck check_entries(const MeshSpace &space, const physics::Kernel<2> &kernel,
                           const std::optional<physics::Coefficient> &coefficient,
                           const algebra::CsrMatrix &rows, unsigned int n_pairs, unsigned int seed);
} // namespace plumbline::reference
