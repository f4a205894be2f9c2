#include "meshfree/rules/rules.h"

namespace plumbline::meshfree
{
  Bond full_area_bond(const Kernel<2> &kernel, const Candidate &candidate)
  {
    const bool is_inside = candidate.xi.norm() <= kernel.horizon() * (1 + tie_tolerance);
    return {candidate.xi, is_inside ? candidate.area : 0, candidate.xi, candidate.area};
  }

  NeighbourhoodQuadrature full_area(const Kernel<2> &)
  {
    return {full_area_bond};
  }
} // namespace plumbline::meshfree
