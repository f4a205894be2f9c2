#include "algebra/slab_operator.h"

namespace plumbline::algebra
{
  SlabOperator::SlabOperator(const Stencil &stencil, const std::array<int, 3> &n,
                             const base::Slabs &slabs, OperatorBackend backend)
      : slabs_(slabs), n_blocks_(stencil.n_blocks()), halo_(stencil.reaches()[2]),
        plane_size_(static_cast<std::size_t>(n[0]) * n[1])
  {
    const std::array<int, 3> own = {n[0], n[1], slabs.n_owned()};
    // as for the whole box, so that rounding does not depend on the number of ranks
    is_direct_ = is_direct(stencil, n, backend);
    if (slabs.n_owned() == 0)
      return;
    with_halo_.resize(n_blocks_ * plane_size_ * (own[2] + 2 * halo_));
    if (is_direct_)
      direct_.emplace(stencil, own, true);
    else
      transforms_.emplace(stencil, own, std::array<int, 3>{0, 0, halo_});
  }

  void SlabOperator::apply(const double *input, double *output) const
  {
    const auto wanted = [this](unsigned int rank) -> base::Slabs::Range
    {
      const auto [first, second] = slabs_.owned(rank);
      return first == second ? base::Slabs::Range{0, 0}
                             : base::Slabs::Range{first - halo_, second + halo_};
    };
    const std::size_t n_own = plane_size_ * slabs_.n_owned();
    for (unsigned int s = 0; s < n_blocks_; ++s)
      slabs_.fetch(input + s * n_own, plane_size_, wanted,
                   with_halo_.data() + s * (with_halo_.size() / n_blocks_));
    if (direct_)
      direct_->apply(with_halo_.data(), output);
    else if (transforms_)
      transforms_->apply(with_halo_.data(), output);
  }
} // namespace plumbline::algebra
