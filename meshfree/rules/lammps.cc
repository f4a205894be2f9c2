#include "meshfree/rules/rules.h"

namespace plumbline::meshfree
{
  namespace
  {
    Bond bond(const Kernel<2> &kernel, const Candidate &candidate)
    {
      Bond result = full_area_bond(kernel, candidate);
      result.weight *= ramp(kernel, candidate);
      return result;
    }
  } // namespace

  NeighbourhoodQuadrature lammps(const Kernel<2> &)
  {
    return {bond};
  }
} // namespace plumbline::meshfree
