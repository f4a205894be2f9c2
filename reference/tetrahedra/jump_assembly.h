#pragma once

#include "reference/tetrahedra/assembly.h"
#include "reference/tetrahedra/bond_factors.h"

namespace plumbline::reference
{
  /// assemble_by_faces() for discontinuous piecewise linear functions. As distributions, ∇φ is
  /// a constant g on each cell and a layer n [φ] on its faces, where [φ] is the jump along the
  /// normal n, and the derivatives of g are layers n [g]. With ΔΛ = γ - m₀ δ and Λ = ΔΨ + κ δ, see
  /// FacePotential, and {g} the mean of both sides,
  ///   ½∬γ (φ_i(x) - φ_i(y)) (φ_j(x) - φ_j(y)) = ∬ Λ ∇φ_i·∇φ_j
  ///     = κ ∫ g_i·g_j + κ Σ_F ∫_F (n·{g_i} [φ_j] + n·{g_j} [φ_i])
  ///     + Σ_F Σ_G ( - n_F·n_G [g_i]·[g_j] ∬_{F×G} Ψ
  ///                 + n_G·[g_i] ∬_{F×G} [φ_j](y) h_F(y) Ψ'/r + n_F·[g_j] ∬_{F×G} [φ_i](x) h_G(x)
  ///                 Ψ'/r
  ///                 + n_F·n_G ∬_{F×G} [φ_i](x) [φ_j](y) Λ ),
  /// where φ_i jumps across F at x, φ_j across G at y, and h_F is the height over F along n_F, as
  /// n_F·∇Ψ(x - y) = -h_F(y) Ψ'/r. The integrals of Ψ are those of continuous functions, exact to
  /// round-off. JumpPairs gives the others, which are multiplied by jumps of values. So, whatever
  /// the quadrature, rows annihilate linear fields, and sums of shape functions that are continuous
  /// have the entries of continuous functions.
  ///
  /// For bond tensors and dilatations, ∬ Λ ∇φ_i·∇φ_j is replaced by
  ///   ∬ (Λ_q ∇φ_i·∇φ_j I + Λ_w ∇φ_i⊗∇φ_j),
  /// see SolidKernel, with the same sums for each term; made symmetric in the components.
  ///
  /// Bonds may have factors a, constant for each pair of cells. A shape function is supported in
  /// one cell, so the entries of two cells T and T' are multiplied by a_TT'. For two functions of
  /// one cell T,
  ///   ½∬aγ (φ_i(x) - φ_i(y)) (φ_j(x) - φ_j(y)) = a_TT ½∬γ (…) (…)
  ///     + ∫_T φ_i φ_j (∫aγ dy - a_TT m₀),
  /// where the expression in parentheses is a sum over the interfaces of groups and the free
  /// surface, see BondDeficit, and its integral is by quadrature to the tolerance
  /// FaceRule::of_jumps. The linear part of the expression is then corrected so that rows
  /// annihilate constants.
  /// @pre  a space of such functions; n_rows is a multiple of 4
  algebra::CsrMatrix
  assemble_with_jumps(const TetrahedralSpace &space, const physics::Kernel<3> &kernel,
                      std::size_t n_rows, const FaceRule &rule, FaceRuleUse *use,
                      const std::optional<physics::Dilatation<3>> &dilatation = {},
                      const BondFactors *factors = nullptr);

  /// The same for continuous functions, as rows of their parts on single cells. The jump terms of
  /// the parts cancel, except on faces where factors differ, and are left out elsewhere. So only
  /// the sums that joined() makes of these rows have a meaning.
  /// @param space  of discontinuous linear functions
  algebra::CsrMatrix assemble_interfaces(const TetrahedralSpace &space,
                                         const physics::Kernel<3> &kernel, std::size_t n_rows,
                                         const FaceRule &rule, FaceRuleUse *use,
                                         const BondFactors &factors);

  /// Rows of continuous functions: sums over the cells around each vertex. Symmetric to round-off.
  /// @param rows  of the free unknowns of the broken space
  algebra::CsrMatrix joined(const TetrahedralSpace &continuous, const TetrahedralSpace &broken,
                            unsigned int n_components, const algebra::CsrMatrix &rows);
} // namespace plumbline::reference
