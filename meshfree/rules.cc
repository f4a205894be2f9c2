#include "meshfree/rules.h"

#include <algorithm>

namespace plumbline::meshfree
{
  const std::vector<Rule> &rules()
  {
    const auto recalibrated_to = [](unsigned int degree)
    {
      return [degree](const Kernel<2> &kernel, double h, Backend backend)
      { return recalibrated(kernel, h, backend, degree); };
    };
    static const std::vector<Rule> table = {
        {"FA", "full area of cells whose node is in the ball", full_area},
        {"LAMMPS", "full area with a ramp inside the horizon", lammps},
        {"QWJ", "full area with a ramp across the horizon", qwj},
        {"PA-AC", "exact partial areas, kernel at the node", partial_area},
        {"IPA-AC", "exact partial areas, kernel at the centroid", improved_partial_area},
        {"IPA-AC-R2", "IPA-AC recalibrated to exact moments of degree 2", recalibrated_to(2)},
        {"IPA-AC-R4", "IPA-AC recalibrated to exact moments of degree 4", recalibrated_to(4)},
        {"OPT", "optimisation-based quadrature weights", optimisation_based},
    };
    return table;
  }

  double kernel_value(const physics::Kernel<2> &kernel, const Bond &bond, unsigned int a,
                      unsigned int b)
  {
    const double radial = kernel.radial(bond.kernel_point.norm());
    const bool is_outside = bond.kernel_point.norm() > kernel.horizon();
    return (is_outside ? std::max(radial, 0.) : radial) *
           kernel.direction_factor(a, b, bond.kernel_point);
  }
} // namespace plumbline::meshfree
