#include "analysis/steps.h"

#include "base/error.h"

#include <deal.II/base/index_set.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/vector.h>
#include <deal.II/sundials/arkode.h>

#include <algorithm>

namespace plumbline::analysis
{
  namespace
  {
    /// @param y  u, then v, of this rank
    template <class Both>
    State split(const Both &y, std::size_t n_own, double t)
    {
      const auto n = static_cast<std::ptrdiff_t>(n_own);
      return {{y.begin(), y.begin() + n}, {y.begin() + n, y.begin() + 2 * n}, t};
    }

    /// How large u becomes until the end, roughly: what it is and where speed and force take it.
    double size_of(const Motion &motion, const State &state, double end)
    {
      constexpr double unknown = 1e-3; // at rest, and nothing moves it yet
      const double time = end - state.t;
      Vector a(motion.n);
      motion.acceleration(state.u, state.t, a);
      const double size = std::max({norm(state.u, motion.ranks), time * norm(state.v, motion.ranks),
                                    time * time * norm(a, motion.ranks)});
      return size > 0 ? size : unknown;
    }

    /// @param y  of the size of u and v; overwritten
    template <class Both>
    void move(const Motion &motion, const Stepping &stepping, double end, State &state,
              const Observer &observer, Counts &counts, Both y)
    {
      using Solver = dealii::SUNDIALS::ARKode<Both>;
      const std::size_t n = motion.n;
      typename Solver::AdditionalData data(state.t, end, .01 * stepping.step, stepping.step,
                                           1e-9 * stepping.step, 8);
      data.absolute_tolerance = stepping.tolerance * size_of(motion, state, end);
      data.relative_tolerance = stepping.tolerance;
      Solver solver(data, motion.ranks.mpi);
      Vector a(n);
      solver.explicit_function = [&](double t, const Both &y_now, Both &rate)
      {
        const State now = split(y_now, n, t);
        motion.acceleration(now.u, t, a);
        ++counts.n_accelerations;
        const auto u_rate = rate.begin(), v_rate = u_rate + static_cast<std::ptrdiff_t>(n);
        for (std::size_t i = 0; i < n; ++i)
        {
          u_rate[i] = now.v[i];
          v_rate[i] = a[i] - motion.damping * now.v[i];
        }
        return 0;
      };
      double last = state.t;
      solver.output_step = [&](double t, const Both &y_now, unsigned int)
      {
        if (t <= last) // the first one is the start
          return;
        last = t;
        ++counts.n_steps;
        if (observer)
          observer(split(y_now, n, t));
      };
      std::copy(state.u.begin(), state.u.end(), y.begin());
      std::copy(state.v.begin(), state.v.end(), y.begin() + static_cast<std::ptrdiff_t>(n));
      try
      {
        solver.solve_ode(y);
      }
      catch (const dealii::ExceptionBase &error)
      {
        throw NumericalError(std::string("ARKODE gives up: ") + error.what());
      }
      state = split(y, n, end);
    }

    /// Of a part of 2 n entries on each rank.
    dealii::LinearAlgebra::distributed::Vector<double> distributed_vector(const Motion &motion)
    {
      const base::Communicator &ranks = motion.ranks;
      std::size_t n_before = 0, n_all = 0;
      for (unsigned int rank = 0; rank < ranks.n_ranks(); ++rank)
      {
        if (rank == ranks.rank())
          n_before = n_all;
        n_all += static_cast<std::size_t>(
            ranks.sum(rank == ranks.rank() ? 2 * static_cast<double>(motion.n) : 0));
      }
      dealii::IndexSet owned(n_all);
      owned.add_range(n_before, n_before + 2 * motion.n);
      owned.compress();
      return dealii::LinearAlgebra::distributed::Vector<double>(owned, ranks.mpi);
    }
  } // namespace

  void runge_kutta(const Motion &motion, const Stepping &stepping, double end, State &state,
                   const Observer &observer, Counts &counts)
  {
    if (motion.ranks.n_ranks() > 1)
      move(motion, stepping, end, state, observer, counts, distributed_vector(motion));
    else
      move(motion, stepping, end, state, observer, counts, dealii::Vector<double>(2 * motion.n));
  }
} // namespace plumbline::analysis
