#pragma once

#include "reference/tetrahedra/face_sides.h"

#include <vector>

namespace plumbline::reference
{
  /// ∫_G (y - x) Λ'(r)/r dy over a face G, r = |y - x|, with the potential Λ of FacePotential. It
  /// is minus the gradient of ∫_G Λ, the potential of a layer on G. As ΔΛ = γ - m₀ δ, the integral
  /// of γ over the bonds of a point x to a part T of space is
  ///   ∫_T γ(|x - y|) dy = m₀ (if x is in T) + Σ_G n_G · ∫_G (y - x) Λ'/r dy,
  /// with the faces G of T and their outward normals. For a bond tensor, see SolidKernel, it is
  /// this sum for q, times I, plus Σ_G ∫_G (y - x) Λ_w'/r dy ⊗ n_G. In the plane of G, with ρ and d
  /// as in JumpPairs, ρ Λ'/r is the gradient of Λ, and Λ'/r is the divergence of (Λ(r) - Λ(d)) ρ /
  /// ρ². So the integral is a sum over sides as there, to about 1e-8. Lengths are in units of the
  /// reach.
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
