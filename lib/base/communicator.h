#pragma once

#include <mpi.h>

#include <cstddef>
#include <functional>
#include <limits>
#include <utility>

namespace plumbline::base
{
  /// The processes that work on one problem together: each takes a share, all get the result.
  struct Communicator
  {
    MPI_Comm mpi = MPI_COMM_WORLD;

    static Communicator all() { return {MPI_COMM_WORLD}; }  ///< every rank of the run
    static Communicator alone() { return {MPI_COMM_SELF}; } ///< this rank by itself

    unsigned int rank() const;
    unsigned int n_ranks() const;

    /// This rank's contiguous share [first, last) of n things.
    std::pair<std::size_t, std::size_t> owned_range(std::size_t n) const;

    /// Another rank's share.
    std::pair<std::size_t, std::size_t> owned_range(std::size_t n, unsigned int rank) const;

    // @note Collective, all of them.
    bool any(bool value) const; ///< whether it is true on some rank
    double sum(double value) const;
    double largest(double value) const;
    void wait() const; ///< until all ranks have come here

    static constexpr double forever = std::numeric_limits<double>::infinity();

    /// Do something on every rank; where one throws, all throw the same, so that none waits for it.
    /// @param patience  that a rank where it failed has with the others [s]: after it they are
    /// taken to wait for this one within the action, so it says why it failed and ends all of them
    /// with the exit code of its error. For actions whose ranks speak with each other; by a
    /// SeparateCommunicator.
    /// @throws InputError, NumericalError, MemoryError  as the action did on the first rank that
    /// failed; where it was out of memory (std::bad_alloc) MemoryError; std::runtime_error with the
    /// message of any other exception
    void together(const std::function<void()> &action, double patience = forever) const;
  };

  /// The same ranks by themselves: what passes between them mixes with nothing that their other
  /// communicators are at.
  class SeparateCommunicator
  {
  public:
    /// @note Collective, as the destructor.
    explicit SeparateCommunicator(const Communicator &ranks);
    ~SeparateCommunicator();
    SeparateCommunicator(const SeparateCommunicator &) = delete;
    SeparateCommunicator &operator=(const SeparateCommunicator &) = delete;

    const Communicator &communicator() const { return communicator_; }

  private:
    Communicator communicator_;
  };
} // namespace plumbline::base
