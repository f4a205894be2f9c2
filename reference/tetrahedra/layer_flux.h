#pragma once

#include "reference/tetrahedra/face_sides.h"

#include <vector>

namespace plumbline::reference
{
  /// ∫_G (y - x) Λ'(r)/r dy over a face G, r = |y - x|, of the potential Λ of FacePotential: the
  /// field of a layer of normals. As ΔΛ = γ - m₀ δ, the bonds of a point x to a part T of space are
  ///   ∫_T γ(|x - y|) dy = m₀ (if x is in T) + Σ_G n_G · ∫_G (y - x) Λ'/r dy,
  /// over the faces G of T with outward normals, and those of a bond tensor, see SolidKernel, have
  /// this for q and Σ_G ∫_G (y - x) Λ_w'/r dy ⊗ n_G besides. In the plane of G, since Λ and
  /// (Λ(r) - Λ(d)) ρ / ρ² have the gradient ρ Λ'/r and the divergence Λ'/r, it is a sum over sides
  /// as in JumpPairs, to about 1e-8. Lengths are in reaches.
  class LayerFlux
  {
  public:
    explicit LayerFlux(const PotentialKernel &kernel);

    /// Thread safe. @pre  x is not on G
    dealii::Tensor<1, 3> operator()(const dealii::Point<3> &x, const FaceSides &face) const;

  private:
    std::vector<PotentialPart<double>> parts_; ///< their r f is r Λ
  };
} // namespace plumbline::reference
