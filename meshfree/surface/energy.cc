#include "meshfree/surface/corrections.h"

namespace plumbline::meshfree
{
  namespace
  {
    /// Twice the energy of u = x_a e_a: c (n·Δu)² = c d_a⁴/r².
    AxisSums energy(const Tensor<1, 2> &d, double /*volume*/, double stiffness)
    {
      AxisSums result{};
      for (unsigned int a = 0; a < 2; ++a)
        result[a] = stiffness * d[a] * d[a] * d[a] * d[a] / d.norm_square();
      return result;
    }
  } // namespace

  /// By the energy densities of uniaxial strains along the axes, g = W0/W at each node, between the
  /// axes by on_ellipse. A node whose bonds all had its own g along an axis would have exactly the
  /// energy density W0 under that strain; means over both ends and the ellipse leave an error.
  /// Source: Madenci & Oterkus 2014, doi:10.1007/978-1-4614-8465-3, sec. 4.2; Le & Bobaru 2018.
  SurfaceCorrection energy_method()
  {
    return {"energy",
            "stiffnesses times the ratio of energy densities under uniaxial strain, bulk over "
            "actual (Madenci & Oterkus 2014)",
            energy, false, on_ellipse};
  }
} // namespace plumbline::meshfree
