#include "meshfree/rules/monte_carlo.h"

#include <cmath>

namespace plumbline::meshfree
{
  template <int dim>
  NeighbourhoodQuadrature<dim> monte_carlo(const Kernel<dim> &kernel)
  {
    const double r = kernel.horizon(), ball = dim == 1   ? 2 * r
                                              : dim == 2 ? M_PI * r * r
                                                         : 4 * M_PI / 3 * r * r * r;
    return {full_area_bond<dim>, [ball](Family<dim> &family)
            {
              const double n = static_cast<double>(family.bonds.size()) + 1; // and the node itself
              for (Bond<dim> &bond : family.bonds)
                bond.weight = ball / n;
            }};
  }

  template NeighbourhoodQuadrature<1> monte_carlo(const Kernel<1> &);
  template NeighbourhoodQuadrature<2> monte_carlo(const Kernel<2> &);
  template NeighbourhoodQuadrature<3> monte_carlo(const Kernel<3> &);
} // namespace plumbline::meshfree
