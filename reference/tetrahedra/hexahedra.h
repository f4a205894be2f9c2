#pragma once

#include "algebra/csr_matrix.h"
#include "physics/kernel.h"
#include "reference/tetrahedra/space.h"

namespace plumbline::reference
{
  /// Gauss points along each axis of the two hexahedra of a pair.
  struct HexahedralRule
  {
    explicit HexahedralRule(unsigned int refinement)
        : n_smooth(3 + refinement), n_cut(4 + 2 * refinement)
    {
    }

    unsigned int n_smooth = 3; ///< of pairs that lie apart and within the horizon, or a part of it
    unsigned int n_cut =
        4; ///< of pairs that touch, or that the horizon cuts; one more in the second
  };

  /// Rows ½∬C(x - y) (φ_i(x) - φ_i(y)) (φ_j(x) - φ_j(y)) of unknowns i = 0 ... n_rows - 1 by all
  /// unknowns j for continuous trilinear functions on hexahedra, in the units of the kernel. With
  /// Λ and κ of FacePotential, and lengths in horizons, this is
  ///   κ ∫∇φ_i·∇φ_j - ½∬Λ(|x - y|) (∇φ_i(x) - ∇φ_i(y))·(∇φ_j(x) - ∇φ_j(y)),
  /// since -ΔΛ = m₀ δ - γ, so that ½∬γ ... = ∬Λ ∇φ_i(x)·∇φ_j(y), and ∫Λ = κ. The second integral
  /// is by Gauss rules. Whatever the rule, the matrix is symmetric to the last bit, constants and
  /// linear fields are annihilated to round-off (their gradients are equal in all points, and that
  /// of φ_i integrates to 0). The second integral vanishes with the horizon, so that in the local
  /// limit the rule only integrates κ ∫∇φ_i·∇φ_j, which it does exactly on parallelepipeds.
  /// @pre  rows of unknowns whose supports are a horizon or more from the outside of the mesh; a
  /// kernel that FacePotential takes
  algebra::CsrMatrix assemble_on_hexahedra(const TetrahedralSpace &space,
                                           const physics::Kernel<3> &kernel, std::size_t n_rows,
                                           const HexahedralRule &rule);
} // namespace plumbline::reference
