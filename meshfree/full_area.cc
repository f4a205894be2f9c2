#include "meshfree/rules.h"

#include <cmath>

namespace plumbline::meshfree
{
  Bonds full_area(const Kernel<2> &kernel, double h, Backend)
  {
    Bonds bonds;
    for_each_offset(kernel.horizon(), h,
                    [&](int k1, int k2)
                    {
                      if (h * std::hypot(k1, k2) <= kernel.horizon() * (1 + tie_tolerance))
                        bonds.family.push_back({k1, k2, h * h, Point<2>(k1 * h, k2 * h), h * h});
                    });
    return bonds;
  }
} // namespace plumbline::meshfree
