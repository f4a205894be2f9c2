#include "algebra/slab_operator.h"

#include <deal.II/base/multithread_info.h>

#include <algorithm>

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
    const int lower = slabs.owned().first == 0 ? 0 : std::min(halo_, slabs.n_owned()),
              upper = slabs.owned().second == n[2] ? slabs.n_owned() : slabs.n_owned() - halo_;
    interior_ = {lower, std::max(lower, upper)};
    with_halo_.resize(n_blocks_ * plane_size_ * (own[2] + 2 * halo_));
    if (is_direct_)
      direct_.emplace(stencil, own, true);
    else
      transforms_.emplace(stencil, own, std::array<int, 3>{0, 0, halo_});
  }

  std::vector<base::PlaneExchange> SlabOperator::post_halo(const double *input) const
  {
    const auto wanted = [this](unsigned int rank) -> base::Slabs::Range
    {
      const auto [first, second] = slabs_.owned(rank);
      return first == second ? base::Slabs::Range{0, 0}
                             : base::Slabs::Range{first - halo_, second + halo_};
    };
    const std::size_t n_own = plane_size_ * slabs_.n_owned();
    std::vector<base::PlaneExchange> exchanges;
    sent_ = {};
    for (unsigned int s = 0; s < n_blocks_; ++s)
    {
      exchanges.emplace_back(slabs_, input + s * n_own, plane_size_, wanted,
                             with_halo_.data() + s * (with_halo_.size() / n_blocks_));
      sent_ += exchanges.back().sent();
    }
    return exchanges;
  }

  void SlabOperator::apply(const double *input, double *output) const
  {
    std::vector<base::PlaneExchange> exchanges = post_halo(input);
    const int n = slabs_.n_owned();
    if (direct_)
    {
      direct_->take(with_halo_.data(), 0, n);
      // planes between looks at messages: few, and enough to share among the rank's threads
      const int step = slabs_.ranks().n_ranks() == 1               ? n
                       : dealii::MultithreadInfo::n_threads() == 1 ? 1
                                                                   : std::max(1, n / 4);
      for (int k = interior_.first; k < interior_.second; k += step)
      {
        direct_->compute(k, std::min(k + step, interior_.second), output);
        for (base::PlaneExchange &exchange : exchanges)
          exchange.advance();
      }
    }
    for (base::PlaneExchange &exchange : exchanges)
      exchange.finish();
    if (direct_)
    {
      direct_->take(with_halo_.data(), -halo_, 0);
      direct_->take(with_halo_.data(), n, n + halo_);
      direct_->compute(0, interior_.first, output);
      direct_->compute(interior_.second, n, output);
    }
    else if (transforms_)
      transforms_->apply(with_halo_.data(), output);
  }
} // namespace plumbline::algebra
