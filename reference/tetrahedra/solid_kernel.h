#pragma once

#include "physics/state_based.h"
#include "reference/tetrahedra/face_potential.h"

#include <optional>

namespace plumbline::reference
{
  /// The radial profiles from which FacePotential makes the entries on tetrahedra of a kernel of
  /// bonds and, optionally, of the dilatation of a state-based solid. They are called the parts of
  /// the kernel, and are relative to the constant of the bonds. A scalar kernel is its only part.
  /// A bond tensor γ ê⊗ê (ê = ξ/r) has two parts,
  ///   q = ∫_r γ/t dt  and  w = γ - 3 q,
  /// since γ ê⊗ê = q I + ∇∇G with G = ∫_r t q dt, whose ΔG is w. G is the Λ of w, and the Λ of G
  /// is the Ψ of w, so that in place of FacePotential's sums (blocks of components a, b)
  ///   ½∬γ ê⊗ê (φ_i(x) - φ_i(y)) (φ_j(x) - φ_j(y)) = Σ_F Σ_G [n_i·n_j I ∬Λ_q + n_i⊗n_j ∬Λ_w]
  ///     = κ_q ∫∇φ_i·∇φ_j I + κ_w ∫∇φ_i⊗∇φ_j
  ///       - Σ_F Σ_G J_i(F) J_j(G) [I ∬Ψ_q + n_F·n_G n_F⊗n_G ∬Ψ_w].
  /// The dilatation is θ = ∫W(|x-y|) div u(y) dy with W = ∫_r K t dt. So f ∫θ_u θ_v adds f W*W, the
  /// convolution, to G, and f Δ(W*W) to w, which then reaches to 2δ.
  struct SolidKernel
  {
    /// @param dilatation  homogeneous; its influence function has the horizon of the bonds
    /// @pre  FacePotential::refuse(bonds) is empty
    explicit SolidKernel(const physics::Kernel<3> &bonds,
                         const std::optional<physics::Dilatation<3>> &dilatation = {});

    double reach = 0;                   ///< the unit of lengths of the parts [length]
    double constant = 0;                ///< of the bonds
    std::vector<PotentialKernel> parts; ///< one; or q and w
    double m0 = 0;                      ///< ∫γ over the ball of the bonds [reach^3]
  };
} // namespace plumbline::reference
