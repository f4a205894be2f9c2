#include "anisotropic/kernel.h"

#include <base/error.h>

#include <cmath>

namespace anisotropic
{
  FibreKernel::FibreKernel(const plumbline::physics::Kernel<2> &radial, double a)
      : radial_(radial), a_(a)
  {
    if (!(std::abs(a) <= 1) || radial.n_components() != 1)
      throw plumbline::InputError("fibres: a = " + std::to_string(a) +
                                  " must be in [-1, 1], and the kernel scalar; choose others");
  }

  double FibreKernel::factor(const Point<2> &xi) const
  {
    return 1 + a_ * (xi[0] * xi[0] - xi[1] * xi[1]) / xi.square();
  }

  std::array<double, 2> FibreKernel::diffusion() const
  {
    // ∫ cos² θ cos 2θ dθ = π/2, where ∫ cos² θ dθ = π
    const double d = radial_.limit().diffusion;
    return {d * (1 + a_ / 2), d * (1 - a_ / 2)};
  }
} // namespace anisotropic
