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
  /// @param polygon  replaces the ball: convex, around the origin, inside of the ball, symmetric
  /// about both axes and under exchange of x and y; empty: the ball
  /// Accuracy: 1e-14 of the largest entry; constants are in the kernel of the operator to
  /// round-off.
  algebra::Stencil galerkin_stencil(const physics::Kernel<2> &kernel, double h,
                                    const AxisShapes &shapes, geometry::Backend backend,
                                    geometry::ArrayView<const geometry::Point<2>> polygon = {});

  /// Quadrature on the kernel's ball ∩ convex polygon, in polar coordinates about the origin: exact
  /// to round-off for the kernel times polynomials of degree below n_modes along each axis.
  /// @param kernel  without breaks
  /// @param length  of the polygon as seen along a ray, relative to the horizon, at most
  geometry::CutRule kernel_rule(const physics::Kernel<2> &kernel,
                                geometry::ArrayView<const geometry::Point<2>> polygon,
                                double length, unsigned int n_modes, geometry::Backend backend);
} // namespace plumbline::reference
