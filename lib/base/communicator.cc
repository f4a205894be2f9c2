#include "base/communicator.h"

#include "base/error.h"
#include "base/memory.h"

#include <array>
#include <chrono>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <thread>

namespace plumbline::base
{
  namespace
  {
    /// A program that has not started MPI is one rank.
    bool is_parallel()
    {
      int is_started = 0;
      MPI_Initialized(&is_started);
      return is_started != 0;
    }

    double reduce(double value, MPI_Op operation, MPI_Comm mpi)
    {
      if (is_parallel())
        MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, operation, mpi);
      return value;
    }

    enum Kind
    {
      good,
      input,
      numerical,
      memory,
      other
    };

    /// What an action threw.
    struct Fault
    {
      int kind = good;
      std::string message = {};
      std::exception_ptr exception = {}; ///< of a library or a caller's function
    };

    Fault attempt(const std::function<void()> &action)
    try
    {
      action();
      return {};
    }
    catch (const InputError &error)
    {
      return {input, error.what()};
    }
    catch (const MemoryError &error)
    {
      return {memory, error.what()};
    }
    catch (const NumericalError &error)
    {
      return {numerical, error.what()};
    }
    catch (const std::bad_alloc &)
    {
      return {memory, out_of_memory()};
    }
    catch (const std::exception &error) // of a library
    {
      return {other, error.what(), std::current_exception()};
    }
    catch (...) // Trilinos throws numbers
    {
      return {other, "a library fails without saying why"};
    }

    [[noreturn]] void raise(const Fault &fault)
    {
      switch (fault.kind)
      {
      case input:
        throw InputError(fault.message);
      case numerical:
        throw NumericalError(fault.message);
      case memory:
        throw MemoryError(fault.message);
      default:
        throw std::runtime_error(fault.message);
      }
    }

    /// The largest value. A rank with a fault waits for the others no longer than its patience.
    double agree(double value, const Fault &fault, double patience,
                 const Communicator &communicator)
    {
      if (!is_parallel())
        return value;
      using Clock = std::chrono::steady_clock;
      const auto start = Clock::now();
      MPI_Request request{};
      MPI_Iallreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, communicator.mpi, &request);
      if (fault.kind == good || patience == Communicator::forever)
      {
        MPI_Wait(&request, MPI_STATUS_IGNORE);
        return value;
      }
      for (int is_done = 0; is_done == 0;)
      {
        MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
        if (is_done == 0 && std::chrono::duration<double>(Clock::now() - start).count() > patience)
        {
          std::cerr << "plumbline: " << fault.message << " (on rank " << communicator.rank()
                    << " alone; the others have not come to hear of it within " << patience
                    << " s, and all are ended)" << std::endl;
          MPI_Abort(communicator.mpi, fault.kind == input ? 2 : 3);
        }
        if (is_done == 0)
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      return value;
    }
  } // namespace

  unsigned int Communicator::rank() const
  {
    int rank = 0;
    if (is_parallel())
      MPI_Comm_rank(mpi, &rank);
    return static_cast<unsigned int>(rank);
  }

  unsigned int Communicator::n_ranks() const
  {
    int n_ranks = 1;
    if (is_parallel())
      MPI_Comm_size(mpi, &n_ranks);
    return static_cast<unsigned int>(n_ranks);
  }

  std::pair<std::size_t, std::size_t> Communicator::owned_range(std::size_t n) const
  {
    return owned_range(n, rank());
  }

  std::pair<std::size_t, std::size_t> Communicator::owned_range(std::size_t n,
                                                                unsigned int rank) const
  {
    return {n * rank / n_ranks(), n * (rank + 1) / n_ranks()};
  }

  bool Communicator::any(bool value) const
  {
    return largest(value ? 1 : 0) > 0;
  }

  double Communicator::sum(double value) const
  {
    return reduce(value, MPI_SUM, mpi);
  }

  double Communicator::largest(double value) const
  {
    return reduce(value, MPI_MAX, mpi);
  }

  void Communicator::together(const std::function<void()> &action, double patience) const
  {
    Fault fault = attempt(action);
    const double own =
        fault.kind == good ? -static_cast<double>(n_ranks()) : -static_cast<double>(rank());
    const double first = -agree(own, fault, patience, *this);
    if (first == n_ranks())
      return;
    if (n_ranks() == 1 && fault.exception)
      std::rethrow_exception(fault.exception); // ranks share words; what is alone keeps the kind
    const int root = static_cast<int>(first);
    if (is_parallel())
    {
      std::array<int, 2> head = {fault.kind, static_cast<int>(fault.message.size())};
      MPI_Bcast(head.data(), 2, MPI_INT, root, mpi);
      fault.kind = head[0];
      fault.message.resize(head[1]);
      MPI_Bcast(fault.message.data(), head[1], MPI_CHAR, root, mpi);
    }
    raise(fault);
  }

  SeparateCommunicator::SeparateCommunicator(const Communicator &ranks) : communicator_(ranks)
  {
    if (is_parallel())
      MPI_Comm_dup(ranks.mpi, &communicator_.mpi);
  }

  SeparateCommunicator::~SeparateCommunicator()
  {
    if (is_parallel() && communicator_.mpi != MPI_COMM_WORLD)
      MPI_Comm_free(&communicator_.mpi);
  }

  void Communicator::wait() const
  {
    if (is_parallel())
      MPI_Barrier(mpi);
  }
} // namespace plumbline::base
