#pragma once

#include "algebra/periodic_box.h"

#include <complex>
#include <vector>

namespace plumbline::algebra
{
  /// The inverse of C⁻¹ restricted to the slab of a periodic box's layer across one axis: block
  /// circulant along the slab, by transforms of its planes and one matrix for each mode.
  class SlabInverse
  {
  public:
    /// Constants, the kernel of C, get the stiffness of the box's longest wave.
    /// @pre the box has a layer across the axis
    /// @throws NumericalError  a mode's matrix is not positive definite to rounding
    SlabInverse(const PeriodicBox &box, unsigned int axis);

    /// Bytes of its matrices.
    static double bytes(unsigned int n_blocks, const std::array<int, 3> &n,
                        const std::array<int, 3> &period, unsigned int axis);

    /// result += the inverse applied to the values on the slab; both arrays are on the layer.
    void add(const PeriodicBox &box, const double *values, double *result) const;

  private:
    void invert(const PeriodicBox &box);
    template <class Visit>
    void for_each_row(const PeriodicBox &box, const Visit &visit) const;

    unsigned int axis_, a_, b_;              ///< across, and the others, of which a is the lower
    int width_ = 0;                          ///< unknowns of one mode: components times planes
    std::size_t n_points_ = 0, n_modes_ = 0; ///< of a plane
    std::vector<double> inverse_;            ///< shape (n_modes, width, width)
    base::AlignedArray<double> planes_;      ///< shape (n_blocks, planes, N[b], N[a])
    base::AlignedArray<std::complex<double>> modes_;
    base::Plan forward_, backward_;
  };
} // namespace plumbline::algebra
