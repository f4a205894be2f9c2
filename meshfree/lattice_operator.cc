#include "meshfree/lattice_operator.h"

#include <algorithm>
#include <cmath>

namespace plumbline::meshfree
{
  algebra::Stencil lattice_operator(const physics::Kernel<2> &kernel, const Bonds &bonds)
  {
    const auto cells = [&](const Bond &bond, unsigned int axis)
    { return static_cast<int>(std::lround(bond.xi[axis] / bonds.h)); };
    int reach = 0;
    for (const Bond &bond : bonds.family)
      for (unsigned int axis = 0; axis < 2; ++axis)
        reach = std::max(reach, std::abs(cells(bond, axis)));
    algebra::Stencil stencil(kernel.n_components(), reach);
    for (const Bond &bond : bonds.family)
      for (unsigned int a = 0; a < kernel.n_components(); ++a)
        for (unsigned int b = 0; b < kernel.n_components(); ++b)
        {
          const double entry = kernel_value(kernel, bond, a, b) * bond.weight;
          stencil(a, b, cells(bond, 0), cells(bond, 1)) -= entry;
          stencil(a, b, 0, 0) += entry;
        }
    return stencil;
  }
} // namespace plumbline::meshfree
