#include "algebra/slab_model.h"

#include "algebra/convolution.h"
#include "algebra/operator.h"

#include <algorithm>
#include <cmath>

namespace plumbline::algebra
{
  namespace
  {
    using base::Traffic;
    using Range = base::Slabs::Range;

    int divide_up(int a, int b)
    {
      return (a + b - 1) / b;
    }

    std::size_t length(const Range &range)
    {
      return static_cast<std::size_t>(range.second - range.first);
    }

    /// Of planes (or rows) in blocks.
    Range block_of(unsigned int rank, int block, int n)
    {
      const auto first = static_cast<long>(rank) * block;
      const auto within = [n](long plane) { return static_cast<int>(std::min<long>(plane, n)); };
      return {within(first), within(first + block)};
    }

    double n_nodes(const std::array<int, 3> &n)
    {
      return static_cast<double>(n[0]) * n[1] * n[2];
    }

    /// @param traffic  of (layout, rank)
    template <class OfRank>
    ModelTime slowest(const SlabLayout &layout, const Rates &rates, double work,
                      const OfRank &traffic)
    {
      const auto seconds = [&](const Traffic &sent)
      {
        return static_cast<double>(sent.n_messages) * rates.latency +
               static_cast<double>(sent.n_bytes) * rates.byte;
      };
      Traffic most;
      for (unsigned int rank = 0; rank < layout.n_ranks; ++rank)
        if (const Traffic sent = traffic(layout, rank); seconds(sent) > seconds(most))
          most = sent;
      return {work, static_cast<double>(most.n_messages) * rates.latency,
              static_cast<double>(most.n_bytes) * rates.byte, most};
    }
  } // namespace

  SlabLayout SlabLayout::of(const Stencil &stencil, const std::array<int, 3> &n,
                            unsigned int n_ranks, int n_planes)
  {
    return {n, stencil.n_blocks(), stencil.reaches()[2], n_ranks,
            divide_up(n_planes, static_cast<int>(n_ranks))};
  }

  Range SlabLayout::owned(unsigned int rank) const
  {
    return block_of(rank, block, n[2]);
  }

  unsigned int SlabLayout::n_working() const
  {
    return std::min(n_ranks, static_cast<unsigned int>(divide_up(n[2], block)));
  }

  Traffic halo_traffic(const SlabLayout &layout, unsigned int rank)
  {
    const Range own = layout.owned(rank);
    const std::size_t plane_bytes = sizeof(double) * layout.n[0] * layout.n[1];
    const auto n_near = static_cast<unsigned int>(divide_up(layout.reach, layout.block));
    Traffic sent;
    for (unsigned int other = rank > n_near ? rank - n_near : 0;
         other <= std::min(rank + n_near, layout.n_working() - 1); ++other)
    {
      const Range there = layout.owned(other);
      const Range wanted = {std::max(own.first, there.first - layout.reach),
                            std::min(own.second, there.second + layout.reach)};
      if (other != rank && wanted.first < wanted.second)
        sent += {1, length(wanted) * plane_bytes};
    }
    return layout.n_blocks * sent;
  }

  Traffic transpose_traffic(const SlabLayout &layout, unsigned int rank)
  {
    const auto &n = layout.n;
    const int row_block = divide_up(n[1], static_cast<int>(layout.n_ranks));
    const Range planes = layout.owned(rank), rows = block_of(rank, row_block, n[1]);
    const auto with_rows = static_cast<unsigned int>(divide_up(n[1], row_block));
    const auto to_others =
        [&](const Range &own, int n_all, const Range &own_there, unsigned int n_receiving)
    {
      if (length(own) == 0)
        return Traffic{};
      const std::size_t there = n_all - length(own_there);
      return Traffic{n_receiving - (length(own_there) > 0 ? 1 : 0),
                     sizeof(double) * n[0] * length(own) * there};
    };
    Traffic sent = to_others(planes, n[1], rows, with_rows);
    sent += to_others(rows, n[2], planes, layout.n_working());
    return layout.n_blocks * sent;
  }

  Traffic reduction_traffic(unsigned int n_ranks)
  {
    const auto n = static_cast<std::uint64_t>(std::ceil(std::log2(n_ranks)));
    return {n, n * sizeof(double)};
  }

  ModelTime &ModelTime::operator+=(const ModelTime &other)
  {
    work += other.work;
    messages += other.messages;
    bytes += other.bytes;
    sent += other.sent;
    return *this;
  }

  ModelTime operator_time(const SlabLayout &layout, const Stencil &stencil, const Rates &rates)
  {
    const std::array<int, 3> own = layout.first_slab();
    const double work =
        is_direct(stencil, layout.n, layout.backend)
            ? rates.bond * static_cast<double>(stencil.n_entries()) * n_nodes(own)
            : Convolution::estimated_seconds(
                  layout.n_blocks, stencil.reaches(),
                  {own[0], own[1], own[2] + layout.reach}); // the halo is transformed, too
    return slowest(layout, rates, work, halo_traffic);
  }

  ModelTime preconditioner_time(const SlabLayout &layout, const Rates &rates)
  {
    const double n_transforms = 2. * layout.n_blocks;
    return slowest(layout, rates,
                   n_transforms * n_nodes(layout.first_slab()) * std::log2(n_nodes(layout.n)) *
                       rates.level,
                   transpose_traffic);
  }

  ModelTime iteration_time(const SlabLayout &layout, const Stencil &stencil, const Rates &rates)
  {
    constexpr double n_values = 13;
    constexpr unsigned int n_reductions = 3;
    ModelTime time = operator_time(layout, stencil, rates);
    time += preconditioner_time(layout, rates);
    time += slowest(layout, rates,
                    n_values * layout.n_blocks * n_nodes(layout.first_slab()) * rates.value,
                    [](const SlabLayout &of, unsigned int)
                    { return n_reductions * reduction_traffic(of.n_ranks); });
    return time;
  }
} // namespace plumbline::algebra
