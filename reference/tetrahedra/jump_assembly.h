#pragma once

#include "reference/tetrahedra/assembly.h"

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
  /// n_F·∇Ψ(x - y) = -h_F(y) Ψ'/r. Integrals of Ψ are those of continuous functions, exact to
  /// round-off; the others, which JumpPairs gives, are multiplied by jumps of values, so that rows
  /// annihilate linear fields, and are those of continuous functions where sums of shape functions
  /// are continuous, whatever the quadrature.
  /// @pre  a space of such functions; n_rows is a multiple of 4
  algebra::CsrMatrix assemble_with_jumps(const TetrahedralSpace &space,
                                         const physics::Kernel<3> &kernel, std::size_t n_rows,
                                         const FaceRule &rule, FaceRuleUse *use);
} // namespace plumbline::reference
