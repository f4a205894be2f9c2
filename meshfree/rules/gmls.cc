#include "meshfree/rules/derivatives.h"
#include "meshfree/rules/moments.h"
#include "meshfree/rules/rules.h"

namespace plumbline::meshfree
{
  namespace
  {
    /// None where ω is 0.
    template <int dim>
    Bond<dim> bond(const Kernel<dim> &kernel, const Candidate<dim> &candidate)
    {
      Bond<dim> result = coefficient_bond(kernel, candidate);
      if (candidate.xi.norm() >= kernel.horizon() * (1 - tie_tolerance))
        result.weight = 0;
      return result;
    }
  } // namespace

  template <int dim>
  NeighbourhoodQuadrature<dim> generalised_moving_least_squares(const Kernel<dim> &kernel)
  {
    return fitted_derivatives<dim>("GMLS", kernel, bond<dim>,
                                   [kernel](const Bond<dim> &bond)
                                   {
                                     const double rest = 1 - bond.xi.norm() / kernel.horizon();
                                     return rest * rest * rest * rest;
                                   });
  }

  template NeighbourhoodQuadrature<2> generalised_moving_least_squares(const Kernel<2> &);
  template NeighbourhoodQuadrature<3> generalised_moving_least_squares(const Kernel<3> &);
} // namespace plumbline::meshfree
