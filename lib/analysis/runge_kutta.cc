#include "analysis/steps.h"

#include "base/error.h"

#include <deal.II/lac/vector.h>
#include <deal.II/sundials/arkode.h>

#include <algorithm>

namespace plumbline::analysis
{
  namespace
  {
    using Both = dealii::Vector<double>; ///< u, then v

    State split(const Both &y, double t)
    {
      const auto n = static_cast<std::ptrdiff_t>(y.size() / 2);
      return {{y.begin(), y.begin() + n}, {y.begin() + n, y.end()}, t};
    }
    /// How large u becomes until the end, roughly: what it is and where speed and force take it.
    double size_of(const Motion &motion, const State &state, double end)
    {
      constexpr double unknown = 1e-3; // at rest, and nothing moves it yet
      const double time = end - state.t;
      Vector a(motion.n);
      motion.acceleration(state.u, state.t, a);
      const double size = std::max({norm(state.u), time * norm(state.v), time * time * norm(a)});
      return size > 0 ? size : unknown;
    }
  } // namespace

  void runge_kutta(const Motion &motion, const Stepping &stepping, double end, State &state,
                   const Observer &observer, Counts &counts)
  {
    using Solver = dealii::SUNDIALS::ARKode<Both>;
    const std::size_t n = motion.n;
    Solver::AdditionalData data(state.t, end, .01 * stepping.step, stepping.step,
                                1e-9 * stepping.step, 8);
    data.absolute_tolerance = stepping.tolerance * size_of(motion, state, end);
    data.relative_tolerance = stepping.tolerance;
    Solver solver(data);
    Vector a(n);
    solver.explicit_function = [&](double t, const Both &y, Both &rate)
    {
      const State now = split(y, t);
      motion.acceleration(now.u, t, a);
      ++counts.n_accelerations;
      for (std::size_t i = 0; i < n; ++i)
      {
        rate[i] = now.v[i];
        rate[n + i] = a[i] - motion.damping * now.v[i];
      }
      return 0;
    };
    double last = state.t;
    solver.output_step = [&](double t, const Both &y, unsigned int)
    {
      if (t <= last) // the first one is the start
        return;
      last = t;
      ++counts.n_steps;
      if (observer)
        observer(split(y, t));
    };
    Both y(2 * n);
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
    state = split(y, end);
  }
} // namespace plumbline::analysis
