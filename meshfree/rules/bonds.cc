#include "meshfree/rules/bonds.h"

#include <algorithm>

namespace plumbline::meshfree
{
  template <int dim>
  double radial_value(const Kernel<dim> &kernel, const Bond<dim> &bond)
  {
    const double r = bond.kernel_point.norm(), value = kernel.radial(r);
    return r > kernel.horizon() ? std::max(value, 0.) : value;
  }

  template <int dim>
  double kernel_value(const Kernel<dim> &kernel, const Bond<dim> &bond, unsigned int a,
                      unsigned int b)
  {
    return radial_value(kernel, bond) * kernel.direction_factor(a, b, bond.kernel_point);
  }

  template double radial_value(const Kernel<1> &, const Bond<1> &);
  template double kernel_value(const Kernel<1> &, const Bond<1> &, unsigned int, unsigned int);
  template double radial_value(const Kernel<2> &, const Bond<2> &);
  template double radial_value(const Kernel<3> &, const Bond<3> &);
  template double kernel_value(const Kernel<2> &, const Bond<2> &, unsigned int, unsigned int);
  template double kernel_value(const Kernel<3> &, const Bond<3> &, unsigned int, unsigned int);
} // namespace plumbline::meshfree
