#include "meshfree/surface/corrections.h"

namespace plumbline::meshfree
{
  std::vector<std::pair<int, double>> odd_extension(int p, int n)
  {
    const int last = n - 1;
    if (p < 0)
      return {{0, 2.}, {-p, -1.}};
    if (p > last)
      return {{last, 2.}, {2 * last - p, -1.}};
    return {{p, 1.}};
  }

  /// The energy is Σ_i V_i W_i over the nodes of the body, each W_i over a whole ball: beyond a
  /// side of a box u is extended to be odd about it, at corners about both sides. Any uniform
  /// strain has its exact energy density at every node, and natural boundary conditions are those
  /// of the local limit. Forces derive from this energy; a scheme that lets fictitious nodes act on
  /// nodes of the body, but not these on the former, is in equilibrium under any uniform strain,
  /// and has no traction-free surface.
  /// Named after the fictitious nodes method in the survey of Le & Bobaru 2018. The energy is
  /// derived here.
  SurfaceCorrection fictitious_nodes()
  {
    return {"mirror", "families completed by fictitious nodes with extrapolated u around one box",
            nullptr,  false,
            nullptr,  true};
  }
} // namespace plumbline::meshfree
