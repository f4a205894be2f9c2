#pragma once

#include "base/communicator.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace plumbline::base
{
  /// Do something on the first of these ranks. If it fails, all of them stop. @note Collective.
  inline void on_first_rank(const Communicator &ranks, const std::function<void()> &action)
  {
    ranks.together(
        [&]
        {
          if (ranks.rank() == 0)
            action();
        });
  }

  /// The first rank's numbers, on all ranks. @note Collective.
  inline std::vector<std::uint64_t> of_first_rank(const Communicator &ranks,
                                                  std::vector<std::uint64_t> numbers)
  {
    if (ranks.n_ranks() == 1)
      return numbers;
    std::uint64_t n = numbers.size();
    MPI_Bcast(&n, 1, MPI_UINT64_T, 0, ranks.mpi);
    numbers.resize(n);
    MPI_Bcast(numbers.data(), static_cast<int>(n), MPI_UINT64_T, 0, ranks.mpi);
    return numbers;
  }
} // namespace plumbline::base
