#include "meshfree/rules.h"

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

  Bonds lammps(const Kernel<2> &kernel, double h, Backend backend)
  {
    return lattice_bonds({bond}, kernel, h, backend);
  }

  Families lammps(const Kernel<2> &kernel, const NodeCells &cells, Backend backend)
  {
    return {{bond}, kernel, cells, backend};
  }
} // namespace plumbline::meshfree
