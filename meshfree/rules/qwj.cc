#include "meshfree/rules/rules.h"

namespace plumbline::meshfree
{
  namespace
  {
    template <int dim>
    Bond<dim> bond(const Kernel<dim> &kernel, const Candidate<dim> &candidate)
    {
      const double share = ramp(kernel, candidate);
      return {candidate.xi, share > tie_tolerance ? share * candidate.area : 0, candidate.xi,
              candidate.area};
    }
  } // namespace

  template <int dim>
  NeighbourhoodQuadrature<dim> qwj(const Kernel<dim> &)
  {
    return {bond<dim>};
  }

  template NeighbourhoodQuadrature<1> qwj(const Kernel<1> &);
  template NeighbourhoodQuadrature<2> qwj(const Kernel<2> &);
  template NeighbourhoodQuadrature<3> qwj(const Kernel<3> &);
} // namespace plumbline::meshfree
