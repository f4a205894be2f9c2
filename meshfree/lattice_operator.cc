#include "meshfree/lattice_operator.h"

#include <algorithm>
#include <cstdlib>

namespace plumbline::meshfree
{
  algebra::Stencil lattice_operator(const physics::Kernel<2> &kernel, const Bonds &bonds)
  {
    int reach = 0;
    for (const Bond &bond : bonds.family)
      reach = std::max({reach, std::abs(bond.k1), std::abs(bond.k2)});
    algebra::Stencil stencil(kernel.n_components(), reach);
    for (const Bond &bond : bonds.family)
      for (unsigned int a = 0; a < kernel.n_components(); ++a)
        for (unsigned int b = 0; b < kernel.n_components(); ++b)
        {
          const double entry = kernel_value(kernel, bond, a, b) * bond.weight;
          stencil(a, b, bond.k1, bond.k2) -= entry;
          stencil(a, b, 0, 0) += entry;
        }
    return stencil;
  }
} // namespace plumbline::meshfree
