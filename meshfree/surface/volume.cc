#include "meshfree/surface/corrections.h"

namespace plumbline::meshfree
{
  namespace
  {
    AxisSums volume_of(const Tensor<1, 2> & /*d*/, double volume, double /*stiffness*/)
    {
      return {volume, volume};
    }

    double factor(const AxisSums &a, const AxisSums &b, const Tensor<1, 2> & /*d*/)
    {
      return 2 / (a[0] + b[0]);
    }
  } // namespace

  /// 2 V0 / (V_i + V_j), where V is the volume of ball ∩ body by the weights, the node's own cell
  /// included, and V0 that of a whole ball. Source: Le & Bobaru 2018, the volume method.
  SurfaceCorrection volume_method()
  {
    return {"volume",
            "stiffnesses times 2V0/(Vi+Vj), V the volume of the family (Le & Bobaru 2018)",
            volume_of, true, factor};
  }
} // namespace plumbline::meshfree
