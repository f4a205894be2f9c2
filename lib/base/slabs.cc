#include "base/slabs.h"

#include <algorithm>

namespace plumbline::base
{
  namespace
  {
    using Range = Slabs::Range;

    Range intersect(const Range &a, const Range &b)
    {
      const int first = std::max(a.first, b.first);
      return {first, std::max(first, std::min(a.second, b.second))};
    }

    /// A plane as one item of a message, so that counts fit into int.
    class PlaneType
    {
    public:
      explicit PlaneType(std::size_t size)
      {
        MPI_Type_contiguous(static_cast<int>(size), MPI_DOUBLE, &type_);
        MPI_Type_commit(&type_);
      }
      ~PlaneType() { MPI_Type_free(&type_); }
      PlaneType(const PlaneType &) = delete;
      PlaneType &operator=(const PlaneType &) = delete;
      MPI_Datatype get() const { return type_; }

    private:
      MPI_Datatype type_{};
    };
  } // namespace

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
    const unsigned int rank = ranks_.rank();
    const Range mine = wanted(rank);
    const auto in_own = [&](int plane) { return own + (plane - owned_.first) * plane_size; };
    const auto in_result = [&](int plane) { return result + (plane - mine.first) * plane_size; };
    const Range inside = intersect(mine, {0, n_planes_}), kept = intersect(mine, owned_);
    std::fill(in_result(mine.first), in_result(std::min(mine.second, inside.first)), 0.);
    std::fill(in_result(std::max(mine.first, inside.second)), in_result(mine.second), 0.);
    if (kept.first < kept.second)
      std::copy(in_own(kept.first), in_own(kept.second), in_result(kept.first));
    if (ranks_.n_ranks() == 1)
      return;
    const PlaneType plane(plane_size);
    std::vector<MPI_Request> requests;
    for (unsigned int other = 0; other < ranks_.n_ranks(); ++other)
    {
      if (other == rank)
        continue;
      const int there = static_cast<int>(other);
      if (const Range from = intersect(mine, owned(other)); from.first < from.second)
        MPI_Irecv(in_result(from.first), from.second - from.first, plane.get(), there, 0,
                  ranks_.mpi, &requests.emplace_back());
      if (const Range to = intersect(wanted(other), owned_); to.first < to.second)
        MPI_Isend(in_own(to.first), to.second - to.first, plane.get(), there, 0, ranks_.mpi,
                  &requests.emplace_back());
    }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
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
