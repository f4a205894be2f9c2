#include "base/plane_exchange.h"

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
      ~PlaneType() { MPI_Type_free(&type_); } // after the messages that use it
      PlaneType(const PlaneType &) = delete;
      PlaneType &operator=(const PlaneType &) = delete;
      MPI_Datatype get() const { return type_; }

    private:
      MPI_Datatype type_{};
    };
  } // namespace

  PlaneExchange::PlaneExchange(const Slabs &slabs, const double *own, std::size_t plane_size,
                               const std::function<Range(unsigned int)> &wanted, double *result)
  {
    const Communicator &ranks = slabs.ranks();
    const unsigned int rank = ranks.rank();
    const Range mine = wanted(rank), owned = slabs.owned();
    const auto in_own = [&](int plane) { return own + (plane - owned.first) * plane_size; };
    const auto in_result = [&](int plane) { return result + (plane - mine.first) * plane_size; };
    const Range inside = intersect(mine, {0, slabs.n_planes()}), kept = intersect(mine, owned);
    std::fill(in_result(mine.first), in_result(std::min(mine.second, inside.first)), 0.);
    std::fill(in_result(std::clamp(inside.second, mine.first, mine.second)), in_result(mine.second),
              0.);
    if (kept.first < kept.second)
      std::copy(in_own(kept.first), in_own(kept.second), in_result(kept.first));
    if (ranks.n_ranks() == 1)
      return;
    const PlaneType plane(plane_size);
    for (unsigned int other = 0; other < ranks.n_ranks(); ++other)
    {
      if (other == rank)
        continue;
      const int there = static_cast<int>(other);
      if (const Range from = intersect(mine, slabs.owned(other)); from.first < from.second)
        MPI_Irecv(in_result(from.first), from.second - from.first, plane.get(), there, 0, ranks.mpi,
                  &requests_.emplace_back());
      if (const Range to = intersect(wanted(other), owned); to.first < to.second)
      {
        MPI_Isend(in_own(to.first), to.second - to.first, plane.get(), there, 0, ranks.mpi,
                  &requests_.emplace_back());
        sent_ += {1, (to.second - to.first) * plane_size * sizeof(double)};
      }
    }
  }

  void PlaneExchange::advance()
  {
    int is_done = 0;
    if (!requests_.empty())
      MPI_Testall(static_cast<int>(requests_.size()), requests_.data(), &is_done,
                  MPI_STATUSES_IGNORE);
  }

  void PlaneExchange::finish()
  {
    if (requests_.empty())
      return; // also where MPI has not been started
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
    requests_.clear();
  }
} // namespace plumbline::base
