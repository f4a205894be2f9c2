#pragma once

#include "geometry/ball_cell.h"
#include "physics/kernel.h"

#include <string>
#include <vector>

namespace plumbline::meshfree
{
  using dealii::Point;
  using geometry::Backend;
  using physics::Kernel;

  /// One bond of a node's family.
  template <int dim>
  struct Bond
  {
    Point<dim> xi;           ///< to the neighbour's node [length]
    double weight = 0;       ///< [length^dim]
    Point<dim> kernel_point; ///< where the kernel is taken, relative to the node [length]
    /// Of ball ∩ cell where the rule uses it, else of the cell: a volume in space [length^dim].
    double area = 0;
  };

  /// How well weights meet the moments that were asked of them.
  struct Fit
  {
    unsigned int degree = 0; ///< of the moments
    unsigned int n_conditions = 0, rank = 0;
    double residual = 0; ///< relative
    /// Of the matrix of conditions, to 1 %: a row g_j s_j^α √ω_j for each of them, scaled to norm
    /// 1, with s = ξ/δ and ω the rule's scale, the area as a rule (see MomentConditions). In [0,
    /// 1]; 1: orthogonal conditions or none; round-off where they depend on one another.
    double smallest_singular_value = 1;
  };

  /// What a meshfree rule yields on a lattice, where all nodes share one family:
  /// L_h u_i = -Σ C(kernel_point) (u(x_i + ξ) - u_i) weight.
  template <int dim>
  struct Bonds
  {
    double h = 0; ///< of the lattice [length]
    std::vector<Bond<dim>> family;
    Fit fit = {};
    std::vector<std::string> notes = {}; ///< what the rule had to do that a user should know
  };

  /// A node counts as inside the ball up to this fraction of the radius beyond it: on lattices
  /// nodes lie on the circle, as in the (3, 4, 5) triangle.
  constexpr double tie_tolerance = 1e-9;

  /// The kernel's radial factor at a bond's kernel point; a negative profile beyond the horizon
  /// counts as 0.
  template <int dim>
  double radial_value(const Kernel<dim> &kernel, const Bond<dim> &bond);

  /// The kernel C_ab at a bond's kernel point.
  template <int dim>
  double kernel_value(const Kernel<dim> &kernel, const Bond<dim> &bond, unsigned int a,
                      unsigned int b);
} // namespace plumbline::meshfree
