#include "base/team.h"

#include "base/error.h"
#include "base/memory.h"

#include <array>
#include <chrono>
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

    double reduce(double value, MPI_Op operation, MPI_Comm communicator)
    {
      if (is_parallel())
        MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, operation, communicator);
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
      std::string message;
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
      return {other, error.what()};
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
    double agree(double value, const Fault &fault, double patience, const Team &team)
    {
      if (!is_parallel())
        return value;
      using Clock = std::chrono::steady_clock;
      const auto start = Clock::now();
      MPI_Request request{};
      MPI_Iallreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, team.communicator, &request);
      if (fault.kind == good || patience == Team::forever)
      {
        MPI_Wait(&request, MPI_STATUS_IGNORE);
        return value;
      }
      for (int is_done = 0; is_done == 0;)
      {
        MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
        if (is_done == 0 && std::chrono::duration<double>(Clock::now() - start).count() > patience)
        {
          std::cerr << "plumbline: " << fault.message << " (on rank " << team.rank()
                    << " alone; the others have not come to hear of it within " << patience
                    << " s, and all are ended)" << std::endl;
          MPI_Abort(team.communicator, fault.kind == input ? 2 : 3);
        }
        if (is_done == 0)
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      return value;
    }
  } // namespace

  unsigned int Team::rank() const
  {
    int rank = 0;
    if (is_parallel())
      MPI_Comm_rank(communicator, &rank);
    return static_cast<unsigned int>(rank);
  }

  unsigned int Team::n_ranks() const
  {
    int n_ranks = 1;
    if (is_parallel())
      MPI_Comm_size(communicator, &n_ranks);
    return static_cast<unsigned int>(n_ranks);
  }

  std::pair<std::size_t, std::size_t> Team::share(std::size_t n) const
  {
    return share(n, rank());
  }

  std::pair<std::size_t, std::size_t> Team::share(std::size_t n, unsigned int rank) const
  {
    return {n * rank / n_ranks(), n * (rank + 1) / n_ranks()};
  }

  bool Team::any(bool value) const
  {
    return largest(value ? 1 : 0) > 0;
  }

  double Team::sum(double value) const
  {
    return reduce(value, MPI_SUM, communicator);
  }

  double Team::largest(double value) const
  {
    return reduce(value, MPI_MAX, communicator);
  }

  void Team::together(const std::function<void()> &action, double patience) const
  {
    Fault fault = attempt(action);
    const double own =
        fault.kind == good ? -static_cast<double>(n_ranks()) : -static_cast<double>(rank());
    const double first = -agree(own, fault, patience, *this);
    if (first == n_ranks())
      return;
    const int root = static_cast<int>(first);
    if (is_parallel())
    {
      std::array<int, 2> head = {fault.kind, static_cast<int>(fault.message.size())};
      MPI_Bcast(head.data(), 2, MPI_INT, root, communicator);
      fault.kind = head[0];
      fault.message.resize(head[1]);
      MPI_Bcast(fault.message.data(), head[1], MPI_CHAR, root, communicator);
    }
    raise(fault);
  }

  SeparateTeam::SeparateTeam(const Team &ranks) : team_(ranks)
  {
    if (is_parallel())
      MPI_Comm_dup(ranks.communicator, &team_.communicator);
  }

  SeparateTeam::~SeparateTeam()
  {
    if (is_parallel() && team_.communicator != MPI_COMM_WORLD)
      MPI_Comm_free(&team_.communicator);
  }

  void Team::wait() const
  {
    if (is_parallel())
      MPI_Barrier(communicator);
  }
} // namespace plumbline::base
