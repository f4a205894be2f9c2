#pragma once

#include <mpi.h>

#include <cstddef>
#include <functional>
#include <utility>

namespace plumbline::base
{
  /// The processes that work on one problem together: each takes a share, all get the result.
  struct Team
  {
    MPI_Comm communicator = MPI_COMM_WORLD;

    static Team all() { return {MPI_COMM_WORLD}; }  ///< every rank of the run
    static Team alone() { return {MPI_COMM_SELF}; } ///< this rank by itself

    unsigned int rank() const;
    unsigned int n_ranks() const;

    /// This rank's contiguous share [first, last) of n things.
    std::pair<std::size_t, std::size_t> share(std::size_t n) const;

    /// Another rank's share.
    std::pair<std::size_t, std::size_t> share(std::size_t n, unsigned int rank) const;

    // @note Collective, all of them.
    bool any(bool value) const; ///< whether it is true on some rank
    double sum(double value) const;
    double largest(double value) const;
    void wait() const; ///< until all ranks have come here

    /// Do something on every rank; where one throws, all throw the same, so that none waits for it.
    /// @throws InputError, NumericalError  as the action did on the first rank that failed
    void together(const std::function<void()> &action) const;
  };
} // namespace plumbline::base
