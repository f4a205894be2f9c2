#pragma once

#include "meshfree/scattered/damage.h"
#include "meshfree/scattered/operator.h"
#include "physics/state_based.h"

namespace plumbline::meshfree
{
  /// A state-based solid on nodes. Nodes of the collar carry data, but for the ghosts.
  struct StateBasedBody
  {
    const geometry::NodeCells<2> *cells = nullptr; ///< Ω and a collar twice as wide as the horizon
    physics::Dilatation<2> dilatation;
    Damage damage = {};
    /// Else θ counts as 0 in the collar. That is wrong, of first order in the horizon and the more
    /// so the less compressible the solid is; it is there to be shown.
    bool has_collar_dilatation = true;
    unsigned int ball_order = 0; ///< see problem::MethodSettings
  };

  /// The operator of `Dilatation` with the bonds that a rule yields for the deviatoric kernel,
  ///   L_h u_i = -Σ_j s_ij [ξ (f_ij θ_i + f_ji θ_j) + 8 μ_ij n⊗n (u_j - u_i)],
  ///   θ_i = Σ_j s_ij ξ·(u_j - u_i),  s = w K(q), n = q/|q|, q the bond's kernel point,
  /// on a share [first, last) of the free nodes, θ eliminated: rows reach twice the horizon. θ is
  /// taken of neighbours in the collar too. μ_ij is the mean of both ends that `Dilatation` says.
  /// Broken bonds: sums over the intact ones, θ with the correction M, and in each row what the
  /// surface terms add for the broken ones. Published: (3.19), with Lamé constants that
  /// `Dilatation` gives at ghosts too. Consistent, d = ξ/|ξ|, n and p across and along the nearest
  /// face, node k the nearest to the foot among i and its intact neighbours:
  ///   Σ_broken w K ξ {2 (λ_i - μ_i) + 4 [(λ_i + 2μ_i) (d·p)² - λ_i (d·n)²]} θ_k,
  /// and none where the foot is near an end of a crack, see Faces. Not symmetric in general.
  /// @param families  of nodes of Ω and of those they reach; of the deviatoric kernel
  /// Accuracy: with exact moments of degree 2 (OPT, IPA-AC-R2) linear fields are reproduced to
  /// round-off, next to a straight free surface those of uniaxial stress along it.
  /// Cost at m = 3: 20 µs a node, families included, and 370 entries; with θ kept half of both.
  /// @throws NumericalError  a family that cannot be made; @throws InputError  a node of Ω all
  /// whose bonds are broken, naming it; a crack through a node; what data and material throw
  /// Source: Fan et al. 2022, doi:10.1016/j.cma.2022.115340, eqs. (3.17)-(3.22).
  ScatteredOperator state_based_operator(const FamilySource<2> &families,
                                         const StateBasedBody &body,
                                         std::pair<std::size_t, std::size_t> share);

  /// The same with θ kept: a system in u, numbered as above, then θ of the nodes of Ω and of those
  /// in the collar that these reach, ascending, A u + B θ = f and θ - D u = g. A is the operator
  /// where θ is left out, that of a solid with λ = μ: in the local limit A ≤ A + B D ≤ (λ + 2μ) /
  /// (3μ) A where λ >= μ, so that A preconditions what eliminating θ yields.
  /// Not for: shares; on several ranks one gives the system to `solve_sparse` and the others
  /// nothing.
  ScatteredOperator state_based_system(const FamilySource<2> &families, const StateBasedBody &body);
} // namespace plumbline::meshfree
