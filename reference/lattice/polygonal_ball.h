#pragma once

#include "geometry/polygon.h"
#include "method/diagnostics.h"
#include "method/method.h"
#include "physics/kernel.h"

namespace plumbline::reference
{
  /// The regular polygon of n sides inscribed in the ball around the origin, with a vertex on each
  /// half axis. Symmetric about both axes and under exchange of x and y.
  /// @param n_sides  a multiple of 4
  geometry::Polygon inscribed_polygon(double horizon, unsigned int n_sides);

  /// ∫ C ξ_1² over the inscribed polygon, relative to that over the ball: the factor of the second
  /// moments, and so of the local limit, if the polygon replaces the ball. In the
  /// polygon the radius ends at δ cos α / cos θ, α = π/n, -α <= θ <= α about the normal of a side.
  /// For C = c (r/δ)^p it is the mean of (cos α / cos θ)^(p+4) over these θ; for a constant kernel
  ///   n/(2π) sin(2π/n) (2 + cos(2π/n))/3 = 1 - 4π²/(3n²) + O(n^-4).
  /// For kernels that vanish at the horizon like (δ - r)^k it is 1 - O(n^-2(k+1)). For bond
  /// tensors these moments ∫ C_ab ξ_c ξ_d are of fourth order in ξ/|ξ|, whose means over the
  /// polygon are those of the ball if n is a multiple of 8: the ratio is the same for all of them.
  /// Accuracy: relative 1e-14 for smooth profiles.
  double second_moment_ratio(const physics::Kernel<2> &kernel, unsigned int n_sides);

  /// Galerkin solutions with the polygon tend to those of its operator, whose local limit differs
  /// in the second moments however many cells the horizon has, and whose limit at a fixed horizon
  /// is that of another kernel.
  /// @pre  bonds alone, no dilatation; for tensors n_sides is a multiple of 8
  method::LimitProof limit_of_polygon(const problem::Problem<2> &problem, unsigned int n_sides);

  /// Q1 on lattices with polygons of 8, 16 and 32 sides: Q1+polygon8, ... They show how the limit
  /// goes wrong, `all` does not include them.
  method::Methods polygonal_balls();
} // namespace plumbline::reference
