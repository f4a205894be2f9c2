#pragma once

#include "algebra/stencil.h"
#include "base/fftw.h"
#include "base/slabs.h"

#include <array>
#include <memory>
#include <vector>

namespace plumbline::algebra
{
  /// The τ preconditioner on a box of nodes of which each rank has a slab, see
  /// make_box_sine_solver: by FFTW's distributed sine transforms, which leave the modes in slabs of
  /// the second axis, so that each transform sends them once.
  class SlabSine
  {
  public:
    /// @param box    nodes along each axis
    /// @param slabs  of the box[2] planes
    /// @pre box[0] > 1 or box[1] > 1
    /// @note Collective, as apply().
    /// @throws NumericalError  an eigenvalue is not positive: the stencil is not coercive
    SlabSine(const Stencil &stencil, const std::array<int, 3> &box, const base::Slabs &slabs);

    /// @param input, output  of this rank, shape (n_components, n_owned, box[1], box[0]); may be
    ///                       the same
    void apply(const double *input, double *output) const;

  private:
    std::size_t n_own_;                                    ///< nodes of this rank
    std::size_t n_modes_ = 0;                              ///< modes of this rank
    std::array<int, 3> modes_{};                           ///< (n[0], rows of this rank, n[2])
    std::vector<std::vector<double>> inverse_eigenvalues_; ///< of each component
    base::AlignedArray<double> field_;                     ///< nodes, or modes
    base::Plan forward_, backward_;
  };
} // namespace plumbline::algebra
