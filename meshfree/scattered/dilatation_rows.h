#pragma once

#include "meshfree/scattered/operator.h"
#include "physics/state_based.h"

namespace plumbline::meshfree
{
  /// What dilatations add to bond_rows() of the deviatoric kernel, the same material everywhere and
  /// all families whole: rows
  ///   -f Σ_j s_ij ξ (θ_i + θ_j),  θ_i = Σ_j s_ij ξ·(u_j - u_i),  s = w K(q), q the kernel point,
  /// of the free nodes, θ eliminated. Columns of all nodes.
  /// @param families  of free nodes, and of those that they reach
  /// Cost at m = 2: .1 ms and 380 nodes a row. Rows reach twice the horizon.
  /// @throws NumericalError  a family that cannot be made
  /// Source: Silling et al. 2007, doi:10.1007/s10659-007-9125-1, sec. 15.
  algebra::CsrMatrix dilatation_rows(const FamilySource<3> &families,
                                     const physics::Dilatation<3> &dilatation,
                                     const geometry::NodeCells<3> &cells);
} // namespace plumbline::meshfree
