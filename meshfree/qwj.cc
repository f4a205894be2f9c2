#include "meshfree/rules.h"

#include <algorithm>
#include <cmath>

namespace plumbline::meshfree
{
  Bonds qwj(const Kernel<2> &kernel, double h, Backend)
  {
    const double horizon = kernel.horizon();
    Bonds bonds;
    bool is_clipped = false;
    for_each_offset(
        horizon, h,
        [&](int k1, int k2)
        {
          const double r = h * std::hypot(k1, k2);
          const double ramp = std::min(1., (horizon + .5 * h - r) / h);
          if (ramp > tie_tolerance)
          {
            bonds.family.push_back({k1, k2, h * h * ramp, Point<2>(k1 * h, k2 * h), h * h});
            is_clipped = is_clipped || (r > horizon && kernel.radial(r) < 0);
          }
        });
    if (is_clipped)
      bonds.notes.push_back("kernel negative at nodes beyond the horizon, clipped at 0");
    return bonds;
  }
} // namespace plumbline::meshfree
