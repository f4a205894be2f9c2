#pragma once

#include "geometry/mesh.h"

#include <vector>

namespace plumbline::reference
{
  /// All cells in an order whose n_ranks equal runs each lie together, so that little of what a
  /// rank needs is of others: along a curve through the quarters of a square, their quarters and
  /// so on (Morton 1966, "A computer oriented geodetic data base"). Of uniform meshes each run is
  /// a square or several; what its boundary touches grows as the root of its area. Files of mesh
  /// generators list cells as they were made, from the boundary to the middle.
  /// @return  none where runs of the given order lie together as well: their bounding boxes have no
  ///          more than 1.5 times the area of the mesh's
  std::vector<unsigned int> order_for_ranks(const geometry::Mesh &mesh, unsigned int n_ranks);
} // namespace plumbline::reference
