#include "meshfree/rules/rules.h"

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

  NeighbourhoodQuadrature qwj(const Kernel<2> &)
  {
    return {bond};
  }
} // namespace plumbline::meshfree
