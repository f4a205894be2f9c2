#include "base/shared_flag.h"

#include <chrono>
#include <thread>

namespace plumbline::base
{
  namespace
  {
    constexpr int tag = 4711; // of no other message
  }

  bool SharedFlag::is_set(bool is_set_here)
  {
    const int n = static_cast<int>(ranks_.n_ranks()), rank = static_cast<int>(ranks_.rank());
    if (n == 1)
      return is_set_ = is_set_ || is_set_here;
    if (is_set_here && !has_told_)
    {
      is_set_ = has_told_ = true;
      for (int other = 0; other < n; ++other)
        if (other != rank)
          MPI_Isend(nullptr, 0, MPI_BYTE, other, tag, ranks_.mpi, &sent_.emplace_back());
    }
    if (!is_set_)
    {
      int has_come = 0;
      MPI_Iprobe(MPI_ANY_SOURCE, tag, ranks_.mpi, &has_come, MPI_STATUS_IGNORE);
      is_set_ = has_come != 0;
    }
    return is_set_;
  }

  void SharedFlag::finish(const std::function<bool()> &is_set_here)
  {
    if (ranks_.n_ranks() == 1)
      return;
    MPI_Request all_are_here{};
    MPI_Ibarrier(ranks_.mpi, &all_are_here);
    for (int is_done = 0; is_done == 0;)
    {
      constexpr std::chrono::milliseconds pause(5);
      std::this_thread::sleep_for(pause);
      is_set(is_set_here());
      MPI_Test(&all_are_here, &is_done, MPI_STATUS_IGNORE);
    }
    const char own = has_told_ ? 1 : 0;
    std::vector<char> have_told(ranks_.n_ranks());
    MPI_Allgather(&own, 1, MPI_CHAR, have_told.data(), 1, MPI_CHAR, ranks_.mpi);
    for (unsigned int other = 0; other < ranks_.n_ranks(); ++other)
      if (have_told[other] != 0 && other != ranks_.rank())
        MPI_Recv(nullptr, 0, MPI_BYTE, static_cast<int>(other), tag, ranks_.mpi, MPI_STATUS_IGNORE);
    MPI_Waitall(static_cast<int>(sent_.size()), sent_.data(), MPI_STATUSES_IGNORE);
    sent_.clear();
  }
} // namespace plumbline::base
