#pragma once

#include "reference/mesh/cells.h"

namespace plumbline::reference
{
  /// How far the fast geometry is from the exact one on a sample of cells that a ball cuts.
  struct GeometryCheck
  {
    unsigned int n_checked = 0;
    double worst_difference = 0; ///< of area and first moments, relative to the cell
  };

  /// Cells of a lattice, the ball around the origin.
  GeometryCheck check_geometry(double horizon, double h, unsigned int n_checks, unsigned int seed);

  /// Cells of a mesh, balls around centroids of cells of it.
  GeometryCheck check_geometry(const MeshCells &cells, double horizon, unsigned int n_checks,
                               unsigned int seed);
} // namespace plumbline::reference
