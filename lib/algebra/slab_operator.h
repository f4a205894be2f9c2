#pragma once

#include "algebra/convolution.h"
#include "algebra/direct.h"
#include "algebra/operator.h"
#include "base/plane_exchange.h"
#include "base/slabs.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace plumbline::algebra
{
  /// A stencil on a box of nodes of which each rank has a slab of planes: the operators of one rank
  /// on the slab, with a halo of planes within reach from the ranks beside it. While these planes
  /// are on their way, a direct stencil is applied to the planes that do not need them; each row is
  /// the same sum in the same order, so bits do not depend on it.
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

    /// What this rank sent in the last apply().
    const base::Traffic &sent() const { return sent_; }

    std::string backend() const { return is_direct_ ? "direct" : "fft"; }

  private:
    std::vector<base::PlaneExchange> post_halo(const double *input) const;

    base::Slabs slabs_;
    unsigned int n_blocks_;
    int halo_; ///< planes on either side
    std::size_t plane_size_;
    bool is_direct_ = false;
    std::optional<DirectStencil> direct_; ///< none of both: this rank has no planes
    std::optional<Convolution> transforms_;
    base::Slabs::Range interior_; ///< planes of this rank that need no planes of others
    mutable base::Traffic sent_;
    mutable std::vector<double> with_halo_; ///< shape (n_blocks, n_owned + 2 halo, n[1], n[0])
  };
} // namespace plumbline::algebra
