#pragma once

#include "meshfree/fracture/connections.h"
#include "meshfree/scattered/faces.h"

namespace plumbline::meshfree
{
  /// Sides of the body, its notch, and faces of cracks that have grown: the sides of cells between
  /// neighbours in a row or column whose bond is broken. What grew at an angle to rows and columns
  /// is a staircase of them, at whose steps Foot::is_near_end holds.
  /// @pre network.surfaces
  Faces find_faces(const BondNetwork<2> &network, const Connections<2> &connections);
} // namespace plumbline::meshfree
