#pragma once

#include <deal.II/base/tensor.h>

#include <array>
#include <string>
#include <vector>

namespace plumbline::meshfree
{
  using dealii::Tensor;

  /// A sum over the bonds of a node for each axis.
  using AxisSums = std::array<double, 2>;

  /// A correction of bonds near free surfaces, where families are truncated and a solid of bonds is
  /// too soft: the stiffness of each bond is multiplied by a factor computed from sums over the
  /// families at its ends. Forces still derive from an energy. For bonds of a solid in the plane,
  /// C = c(r) d⊗d/r².
  /// Survey: Le & Bobaru 2018, doi:10.1007/s00466-017-1469-1.
  struct SurfaceCorrection
  {
    std::string name, help;
    /// What a bond adds to the sums of its node. Null: bonds are not changed.
    /// @param d          to the neighbour [length]
    /// @param volume     weight of the bond [length^2]
    /// @param stiffness  weight times c(r)
    AxisSums (*of_bond)(const Tensor<1, 2> &d, double volume, double stiffness) = nullptr;
    bool counts_own_volume = false; ///< sums begin with the volume of the node's own cell
    /// The factor of a bond.
    /// @param a, b  sums at its ends, relative to those of a whole family; > 0
    double (*factor)(const AxisSums &a, const AxisSums &b, const Tensor<1, 2> &d) = nullptr;
    /// Families are completed by fictitious nodes, whose displacements are extrapolated.
    bool is_fictitious = false;
  };

  // One file each, and one row of surface_corrections().
  SurfaceCorrection volume_method();
  SurfaceCorrection force_density_method();
  SurfaceCorrection energy_method();
  SurfaceCorrection fictitious_nodes();

  /// All of them; the first one is `none`.
  const std::vector<SurfaceCorrection> &surface_corrections();

  /// Of factors g = bulk / sum along the axes at both ends: that along a bond, on the ellipse of
  /// the mean g as semi-axes,
  ///   1 / √((n_1/g_1)² + (n_2/g_2)²),  g = (g_a + g_b)/2,  n = d/|d|.
  /// Source: Madenci & Oterkus 2014, doi:10.1007/978-1-4614-8465-3, sec. 4.2.
  double on_ellipse(const AxisSums &a, const AxisSums &b, const Tensor<1, 2> &d);

  /// A value at a fictitious node of a row of nodes 0 ... n - 1 as a combination of two values:
  /// extrapolated to be odd about the end, u(-p) = 2u(0) - u(p), which is exact for linear fields.
  /// At nodes of the row it is the value itself.
  /// @pre -n < p < 2n - 1
  std::vector<std::pair<int, double>> odd_extension(int p, int n);
} // namespace plumbline::meshfree
