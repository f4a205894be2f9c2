#include "meshfree/surface/corrections.h"

#include <cmath>

namespace plumbline::meshfree
{
  const std::vector<SurfaceCorrection> &surface_corrections()
  {
    static const std::vector<SurfaceCorrection> table = {
        {"none", "no surface correction: bonds are too soft near surfaces"},
        volume_method(),
        force_density_method(),
        energy_method(),
        fictitious_nodes(),
    };
    return table;
  }

  double on_ellipse(const AxisSums &a, const AxisSums &b, const Tensor<1, 2> &d)
  {
    double sum = 0;
    for (unsigned int axis = 0; axis < 2; ++axis)
    {
      const double g = .5 * (1 / a[axis] + 1 / b[axis]), n = d[axis] / d.norm();
      sum += n * n / (g * g);
    }
    return 1 / std::sqrt(sum);
  }
} // namespace plumbline::meshfree
