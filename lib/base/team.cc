#include "base/team.h"

#include "base/error.h"

#include <array>
#include <string>

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

  void Team::together(const std::function<void()> &action) const
  {
    enum Kind
    {
      good,
      input,
      numerical
    };
    int kind = good;
    std::string message;
    try
    {
      action();
    }
    catch (const InputError &error)
    {
      kind = input;
      message = error.what();
    }
    catch (const NumericalError &error)
    {
      kind = numerical;
      message = error.what();
    }
    const double first =
        -largest(kind == good ? -static_cast<double>(n_ranks()) : -static_cast<double>(rank()));
    if (first == n_ranks())
      return;
    const int root = static_cast<int>(first);
    if (is_parallel())
    {
      std::array<int, 2> head = {kind, static_cast<int>(message.size())};
      MPI_Bcast(head.data(), 2, MPI_INT, root, communicator);
      kind = head[0];
      message.resize(head[1]);
      MPI_Bcast(message.data(), head[1], MPI_CHAR, root, communicator);
    }
    if (kind == input)
      throw InputError(message);
    throw NumericalError(message);
  }

  void Team::wait() const
  {
    if (is_parallel())
      MPI_Barrier(communicator);
  }
} // namespace plumbline::base
