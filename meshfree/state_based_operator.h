#pragma once

#include "meshfree/damage.h"
#include "meshfree/scattered_operator.h"
#include "physics/state_based.h"

namespace plumbline::meshfree
{
  /// A state-based solid on nodes. Nodes of the collar carry data, but for the ghosts.
  struct StateBasedBody
  {
    const geometry::NodeCells *cells; ///< Ω and a collar twice as wide as the horizon
    physics::Dilatation dilatation;
    std::function<double(const Point<2> &, unsigned int component)> data; ///< u in the collar
    Damage damage = {};
  };

  /// The operator of `Dilatation` with the bonds that a rule yields for the deviatoric kernel,
  ///   L_h u_i = -Σ_j s_ij [ξ (f_ij θ_i + f_ji θ_j) + 8 μ_ij n⊗n (u_j - u_i)],
  ///   θ_i = Σ_j s_ij ξ·(u_j - u_i),  s = w K(q), n = q/|q|, q the bond's kernel point,
  /// on a share [first, last) of the free nodes, θ eliminated: rows reach twice the horizon. θ is
  /// taken of neighbours in the collar too. μ_ij is the mean of both ends that `Dilatation` says.
  /// Broken bonds: sums over the intact ones, θ with the correction M, and in each row what the
  /// broken ones add at a free surface, (3.19), with Lamé constants that `Dilatation` gives at
  /// ghosts too. Not symmetric in general.
  /// @param families  of nodes of Ω and of those they reach; of the deviatoric kernel
  /// Accuracy: with exact moments of degree 2 (OPT, IPA-AC-R2) linear fields are reproduced to
  /// round-off, next to a straight free surface those of uniaxial stress along it.
  /// Cost at m = 3: 20 µs a node, families included, and 370 entries; with θ kept half of both.
  /// @throws NumericalError  a family that cannot be made; @throws InputError  a node of Ω all
  /// whose bonds are broken, naming it; a crack through a node; what data and material throw
  /// Source: Fan et al. 2022, doi:10.1016/j.cma.2022.115340, eqs. (3.17)-(3.22).
  ScatteredOperator state_based_operator(const FamilySource &families, const StateBasedBody &body,
                                         std::pair<std::size_t, std::size_t> share);

  /// The same with θ kept: a system in (u_1, u_2, θ) of each node of Ω, then θ of the nodes in the
  /// collar that these reach, ascending. Loads belong to rows 3 i + component.
  /// Not for: shares; on several ranks one gives the system to `solve_sparse` and the others
  /// nothing.
  ScatteredOperator state_based_system(const FamilySource &families, const StateBasedBody &body);
} // namespace plumbline::meshfree
