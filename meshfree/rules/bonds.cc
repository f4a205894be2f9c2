#include "meshfree/rules/bonds.h"

#include <algorithm>

namespace plumbline::meshfree
{
  double radial_value(const Kernel<2> &kernel, const Bond &bond)
  {
    const double r = bond.kernel_point.norm(), value = kernel.radial(r);
    return r > kernel.horizon() ? std::max(value, 0.) : value;
  }

  double kernel_value(const Kernel<2> &kernel, const Bond &bond, unsigned int a, unsigned int b)
  {
    return radial_value(kernel, bond) * kernel.direction_factor(a, b, bond.kernel_point);
  }
} // namespace plumbline::meshfree
