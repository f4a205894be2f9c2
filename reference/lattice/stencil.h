#pragma once

#include "algebra/stencil.h"
#include "geometry/ball_cell.h"
#include "physics/kernel.h"
#include "reference/shapes.h"

namespace plumbline::reference
{
  /// The Galerkin matrix of a homogeneous kernel on a uniform lattice as a stencil:
  /// A_st(k) = ∫_{|z|<δ} C(z) [c_k(0) - c_k(z)] dz with the correlations c_k(z) = ∫ φ_s(x) φ_t,k(x
  /// + z) dx. c_k is a polynomial on each lattice cell, so cell ∩ ball is integrated in polar
  /// coordinates to round-off. Blocks as in geometry::NodeSet; entries [unit of C length^(2 dim)].
  /// Accuracy: 1e-14 of the largest entry; constants are in the kernel of the operator to
  /// round-off.
  algebra::Stencil galerkin_stencil(const physics::Kernel<2> &kernel, double h,
                                    const AxisShapes &shapes, geometry::Backend backend);
} // namespace plumbline::reference
