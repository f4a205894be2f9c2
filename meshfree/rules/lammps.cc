#include "meshfree/rules/rules.h"

namespace plumbline::meshfree
{
  namespace
  {
    template <int dim>
    Bond<dim> bond(const Kernel<dim> &kernel, const Candidate<dim> &candidate)
    {
      Bond<dim> result = full_area_bond(kernel, candidate);
      result.weight *= ramp(kernel, candidate);
      return result;
    }
  } // namespace

  template <int dim>
  NeighbourhoodQuadrature<dim> lammps(const Kernel<dim> &)
  {
    return {bond<dim>};
  }

  template NeighbourhoodQuadrature<1> lammps(const Kernel<1> &);
  template NeighbourhoodQuadrature<2> lammps(const Kernel<2> &);
  template NeighbourhoodQuadrature<3> lammps(const Kernel<3> &);
} // namespace plumbline::meshfree
