#include "meshfree/rules.h"

#include <algorithm>
#include <cmath>

namespace plumbline::meshfree
{
  Bonds lammps(const Kernel<2> &kernel, double h, Backend)
  {
    const double horizon = kernel.horizon();
    Bonds bonds;
    for_each_offset(
        horizon, h,
        [&](int k1, int k2)
        {
          const double r = h * std::hypot(k1, k2);
          if (r <= horizon * (1 + tie_tolerance))
          {
            const double ramp = std::min(1., (horizon + .5 * h - r) / h);
            bonds.family.push_back({k1, k2, h * h * ramp, Point<2>(k1 * h, k2 * h), h * h});
          }
        });
    return bonds;
  }
} // namespace plumbline::meshfree
