#pragma once

#include "geometry/ball_cell.h"
#include "physics/kernel.h"

#include <string>
#include <vector>

namespace plumbline::meshfree
{
  using dealii::Point;

  /// One bond of the family that all nodes of a lattice share.
  struct Bond
  {
    int k1, k2;            ///< offset of the neighbour, in cells
    double weight;         ///< [length^2]
    Point<2> kernel_point; ///< where the kernel is taken, relative to the node [length]
    double area;           ///< of ball ∩ cell where the rule uses it, else of the cell [length^2]
  };

  /// What a meshfree rule yields on a lattice: L_h u_i = -Σ C(kernel_point) (u_{i+k} - u_i) weight.
  struct Bonds
  {
    std::vector<Bond> family;
    std::vector<std::string> notes; ///< what the rule had to do that a user should know
  };

  /// A node counts as inside the ball up to this fraction of the radius beyond it: on lattices
  /// nodes lie on the circle, as in the (3, 4, 5) triangle.
  constexpr double tie_tolerance = 1e-9;

  /// The kernel C_ab at a bond's kernel point; a negative profile beyond the horizon counts as 0.
  double kernel_value(const physics::Kernel<2> &kernel, const Bond &bond, unsigned int a,
                      unsigned int b);

  /// Visit all offsets k ≠ 0 of cells whose nearest point to the node is inside the ball.
  template <class Action>
  void for_each_offset(double horizon, double h, const Action &action)
  {
    const int n = static_cast<int>(horizon / h + .5 + tie_tolerance);
    for (int k2 = -n; k2 <= n; ++k2)
      for (int k1 = -n; k1 <= n; ++k1)
        if (k1 != 0 || k2 != 0)
          action(k1, k2);
  }
} // namespace plumbline::meshfree
