#pragma once

#include "algebra/convolution.h"
#include "algebra/direct.h"
#include "algebra/operator.h"
#include "base/slabs.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace plumbline::algebra
{
  /// A stencil on a box of nodes of which each rank has a slab of planes: the operators of one rank
  /// on the slab, with a halo of planes within reach from the ranks beside it.
  class SlabOperator
  {
  public:
    /// @param n      nodes along each axis
    /// @param slabs  of the n[2] planes
    /// @throws InputError  a backend that cannot do it, see `make_operator`
    SlabOperator(const Stencil &stencil, const std::array<int, 3> &n, const base::Slabs &slabs,
                 OperatorBackend backend);

    /// @param input, output  of this rank, shape (n_blocks, n_owned, n[1], n[0])
    /// @note Collective. Not for several threads at once.
    void apply(const double *input, double *output) const;

    std::string backend() const { return is_direct_ ? "direct" : "fft"; }

  private:
    base::Slabs slabs_;
    unsigned int n_blocks_;
    int halo_; ///< planes on either side
    std::size_t plane_size_;
    bool is_direct_ = false;
    std::optional<DirectStencil> direct_; ///< none of both: this rank has no planes
    std::optional<Convolution> transforms_;
    mutable std::vector<double> with_halo_; ///< shape (n_blocks, n_owned + 2 halo, n[1], n[0])
  };
} // namespace plumbline::algebra
