#pragma once

#include "algebra/stencil.h"
#include "physics/state_based.h"
#include "reference/shapes.h"

#include <optional>

namespace plumbline::reference
{
  /// The Galerkin matrix of a homogeneous kernel on a uniform lattice in space, as in stencil.h,
  /// and of a dilatation, whose kernel reaches to 2δ (physics::DilatationInSpace). Cell ∩ ball is
  /// integrated by cones from the cell's corner next to the origin: over its faces and over the
  /// part of the sphere in it. Family = s1 + n (s2 + n s3), n families along an axis.
  /// Accuracy: 1e-14 of the largest entry; constants are in the kernel of the operator to
  /// round-off.
  algebra::Stencil galerkin_stencil(const physics::Kernel<3> &kernel, double h,
                                    const AxisShapes &shapes,
                                    const std::optional<physics::Dilatation<3>> &dilatation = {});
} // namespace plumbline::reference
