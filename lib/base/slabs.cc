#include "base/slabs.h"

#include "base/plane_exchange.h"

#include <algorithm>

namespace plumbline::base
{
  Slabs::Slabs(Communicator ranks, int n_planes, int block)
      : ranks_(ranks), n_planes_(n_planes), block_(block)
  {
    owned_ = owned(ranks_.rank());
  }

  Slabs::Slabs(const Communicator &ranks, int n_planes)
      : Slabs(ranks, n_planes,
              (n_planes + static_cast<int>(ranks.n_ranks()) - 1) /
                  static_cast<int>(ranks.n_ranks()))
  {
  }

  Slabs Slabs::with_planes(int n_planes) const
  {
    return {ranks_, n_planes, block_};
  }

  Slabs::Range Slabs::owned(unsigned int rank) const
  {
    const auto first = static_cast<long>(rank) * block_;
    const auto within = [this](long plane)
    { return static_cast<int>(std::min<long>(plane, n_planes_)); };
    return {within(first), within(first + block_)};
  }

  void Slabs::fetch(const double *own, std::size_t plane_size,
                    const std::function<Range(unsigned int)> &wanted, double *result) const
  {
    PlaneExchange(*this, own, plane_size, wanted, result).finish();
  }

  std::vector<double> Slabs::fetch(const std::vector<double> &own, std::size_t plane_size,
                                   const std::function<Range(unsigned int)> &wanted) const
  {
    const Range mine = wanted(ranks_.rank());
    std::vector<double> result((mine.second - mine.first) * plane_size);
    fetch(own.data(), plane_size, wanted, result.data());
    return result;
  }

  std::vector<double> Slabs::gather(const std::vector<double> &own, std::size_t plane_size) const
  {
    return fetch(own, plane_size,
                 [this](unsigned int rank) -> Range {
                   return {0, rank == 0 ? n_planes_ : 0};
                 });
  }
} // namespace plumbline::base
