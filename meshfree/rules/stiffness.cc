#include "meshfree/rules/stiffness.h"

#include "base/error.h"

namespace plumbline::meshfree
{
  template <int dim>
  physics::CubicStiffness stiffness(const Kernel<dim> &kernel, const Bonds<dim> &bonds)
  {
    if (kernel.n_components() == 1)
      throw InputError("a scalar kernel has no elastic constants; take a tensor such as "
                       "'bond-tensor'");
    double along = 0, across = 0, mixed = 0;
    for (const Bond<dim> &bond : bonds.family)
    {
      const Point<dim> &xi = bond.xi;
      along += .5 * bond.weight * kernel_value(kernel, bond, 0, 0) * xi[0] * xi[0];
      across += .5 * bond.weight * kernel_value(kernel, bond, 0, 0) * xi[1] * xi[1];
      mixed += bond.weight * kernel_value(kernel, bond, 0, 1) * xi[0] * xi[1];
    }
    return {along, mixed - across, across};
  }

  template physics::CubicStiffness stiffness(const Kernel<2> &, const Bonds<2> &);
  template physics::CubicStiffness stiffness(const Kernel<3> &, const Bonds<3> &);
} // namespace plumbline::meshfree
