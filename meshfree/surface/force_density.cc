#include "meshfree/surface/corrections.h"

#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    /// u = x_a e_a makes the force density c d_a²/r along d/r; magnitude of its component a.
    AxisSums force(const Tensor<1, 2> &d, double /*volume*/, double stiffness)
    {
      AxisSums result{};
      for (unsigned int a = 0; a < 2; ++a)
        result[a] = stiffness * std::abs(d[a] * d[a] * d[a]) / d.norm_square();
      return result;
    }
  } // namespace

  /// By the force densities of uniaxial strains ε along the axes, F = Σ V_j |f·e|, which in the
  /// whole ball are those of its two halves together; signed they cancel there. g = F0/F at each
  /// node, between the axes by on_ellipse.
  /// Named after the force density method in the survey of Le & Bobaru 2018. That forces on either
  /// side count with their magnitudes is the reading here: a sum with signs is 0 in the bulk.
  SurfaceCorrection force_density_method()
  {
    return {"force-density",
            "stiffnesses times the ratio of force densities under uniaxial strain, bulk over "
            "actual (Le & Bobaru 2018)",
            force, false, on_ellipse};
  }
} // namespace plumbline::meshfree
