#include "meshfree/rules.h"

namespace plumbline::meshfree
{
  Bond full_area_bond(const Kernel<2> &kernel, const Candidate &candidate)
  {
    const bool is_inside = candidate.xi.norm() <= kernel.horizon() * (1 + tie_tolerance);
    return {candidate.xi, is_inside ? candidate.area : 0, candidate.xi, candidate.area};
  }

  Bonds full_area(const Kernel<2> &kernel, double h, Backend backend)
  {
    return lattice_bonds({full_area_bond}, kernel, h, backend);
  }

  Families full_area(const Kernel<2> &kernel, const NodeCells &cells, Backend backend)
  {
    return {{full_area_bond}, kernel, cells, backend};
  }
} // namespace plumbline::meshfree
