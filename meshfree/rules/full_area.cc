#include "meshfree/rules/rules.h"

namespace plumbline::meshfree
{
  template <int dim>
  Bond<dim> full_area_bond(const Kernel<dim> &kernel, const Candidate<dim> &candidate)
  {
    const bool is_inside = candidate.xi.norm() <= kernel.horizon() * (1 + tie_tolerance);
    return {candidate.xi, is_inside ? candidate.area : 0, candidate.xi, candidate.area};
  }

  template <int dim>
  NeighbourhoodQuadrature<dim> full_area(const Kernel<dim> &)
  {
    return {full_area_bond<dim>};
  }

  template Bond<1> full_area_bond(const Kernel<1> &, const Candidate<1> &);
  template NeighbourhoodQuadrature<1> full_area(const Kernel<1> &);
  template Bond<2> full_area_bond(const Kernel<2> &, const Candidate<2> &);
  template NeighbourhoodQuadrature<2> full_area(const Kernel<2> &);
  template Bond<3> full_area_bond(const Kernel<3> &, const Candidate<3> &);
  template NeighbourhoodQuadrature<3> full_area(const Kernel<3> &);
} // namespace plumbline::meshfree
