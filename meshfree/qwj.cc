#include "meshfree/rules.h"

namespace plumbline::meshfree
{
  namespace
  {
    Bond bond(const Kernel<2> &kernel, const Candidate &candidate)
    {
      const double share = ramp(kernel, candidate);
      return {candidate.xi, share > tie_tolerance ? share * candidate.area : 0, candidate.xi,
              candidate.area};
    }
  } // namespace

  Bonds qwj(const Kernel<2> &kernel, double h, Backend backend)
  {
    return lattice_bonds({bond}, kernel, h, backend);
  }

  Families qwj(const Kernel<2> &kernel, const NodeCells &cells, Backend backend)
  {
    return {{bond}, kernel, cells, backend};
  }
} // namespace plumbline::meshfree
