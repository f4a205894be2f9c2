#pragma once

#include <physics/kernel.h>

#include <array>

namespace anisotropic
{
  using dealii::Point;

  /// C(ξ) = c ρ(|ξ|/δ) (1 + a cos 2θ), θ the angle of ξ to the x axis: bonds along fibres are the
  /// stiffer ones.
  class FibreKernel
  {
  public:
    /// @param radial  c ρ, scalar
    /// @param a       in [-1, 1], so that C >= 0
    /// @throws InputError  otherwise
    FibreKernel(const plumbline::physics::Kernel<2> &radial, double a);

    /// 1 + a cos 2θ. ξ ≠ 0
    double factor(const Point<2> &xi) const;

    /// ½ ∫ C ξ_1², ½ ∫ C ξ_2²: the limit δ → 0 is -(first ∂_xx + second ∂_yy).
    std::array<double, 2> diffusion() const;

  private:
    plumbline::physics::Kernel<2> radial_;
    double a_;
  };
} // namespace anisotropic
