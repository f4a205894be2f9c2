#include "meshfree/rules/stiffness.h"

#include "base/error.h"

namespace plumbline::meshfree
{
  template <int dim>
  physics::CubicStiffness stiffness(const Kernel<dim> &kernel, const std::vector<Bond<dim>> &bonds)
  {
    if (kernel.n_components() == 1)
      throw InputError("a scalar kernel has no elastic constants; take a tensor such as "
                       "'bond-tensor'");
    double along = 0, across = 0, mixed = 0;
    for (const Bond<dim> &bond : bonds)
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = 0; b < dim; ++b)
        {
          const double C = bond.weight * kernel_value(kernel, bond, a, a);
          if (a == b)
            along += C * bond.xi[a] * bond.xi[a] / (2 * dim);
          else
          {
            across += C * bond.xi[b] * bond.xi[b] / (2 * dim * (dim - 1));
            mixed += bond.weight * kernel_value(kernel, bond, a, b) * bond.xi[a] * bond.xi[b] /
                     (dim * (dim - 1));
          }
        }
    return {along, mixed - across, across};
  }

  template physics::CubicStiffness stiffness(const Kernel<2> &, const std::vector<Bond<2>> &);
  template physics::CubicStiffness stiffness(const Kernel<3> &, const std::vector<Bond<3>> &);
} // namespace plumbline::meshfree
