#pragma once

#include "geometry/mesh.h"

#include <vector>

namespace plumbline::reference
{
  /// All cells in an order whose n_ranks equal runs are compact, so that a rank needs few data of
  /// other ranks: along a space-filling curve through the quarters of a square, their quarters and
  /// so on (Morton 1966, "A computer oriented geodetic data base"). In uniform meshes each run is
  /// one or several squares; its boundary grows as the square root of its area. Files of mesh
  /// generators list cells as they were made, from the boundary to the middle.
  /// @return  empty if runs of the given order are compact as well: their bounding boxes have no
  ///          more than 1.5 times the area of the mesh's
  std::vector<unsigned int> order_for_ranks(const geometry::Mesh &mesh, unsigned int n_ranks);
} // namespace plumbline::reference
