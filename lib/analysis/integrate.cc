#include "analysis/integrate.h"

#include "analysis/steps.h"
#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

namespace plumbline::analysis
{
  namespace
  {
    /// A whole number of steps may be missed by this.
    constexpr double step_tolerance = 1e-9;

    template <typename... Parts>
    [[noreturn]] void refuse(const Parts &...parts)
    {
      std::ostringstream message;
      (message << ... << parts);
      throw InputError(message.str());
    }

    /// 0 x is 0, or not a number; sums that do not wait for each other.
    bool is_finite(const Vector &x)
    {
      constexpr std::size_t n_sums = 8;
      double sums[n_sums] = {};
      for (std::size_t i = 0; i + n_sums <= x.size(); i += n_sums)
        for (std::size_t l = 0; l < n_sums; ++l)
          sums[l] += 0 * x[i + l];
      for (std::size_t i = x.size() / n_sums * n_sums; i < x.size(); ++i)
        sums[0] += 0 * x[i];
      return std::all_of(std::begin(sums), std::end(sums), [](double sum) { return sum == 0; });
    }

    bool is_finite(const State &state)
    {
      return is_finite(state.u) && is_finite(state.v);
    }

    void check(const Motion &motion, const Scheme &scheme, const Stepping &stepping, double end,
               const State &state)
    {
      if (!(stepping.step > 0) || !std::isfinite(stepping.step))
        refuse("time step = ", stepping.step, " must be positive and finite");
      if (!(motion.damping >= 0))
        refuse("damping = ", motion.damping, " must not be negative");
      if (!(end >= state.t) || !std::isfinite(end))
        refuse("final time = ", end, " lies before the initial time ", state.t);
      if (state.u.size() != motion.n || state.v.size() != motion.n)
        refuse("initial state: ", state.u.size(), " displacements and ", state.v.size(),
               " velocities for ", motion.n, " unknowns");
      if (!is_finite(state))
        refuse("initial state: a displacement or velocity is not finite; look for a division by "
               "zero in its formula");
      if (scheme.is_implicit() && !motion.tangent)
        refuse("the scheme ", scheme.name,
               " needs the tangent of the forces, which this model "
               "does not have; take an explicit one");
      if (stepping.critical_step && !stepping.shows_blow_up && !scheme.is_implicit() &&
          !scheme.is_runge_kutta && stepping.step > *stepping.critical_step)
        refuse("time step = ", stepping.step, " is longer than the critical step ",
               *stepping.critical_step, " of the scheme ", scheme.name,
               ", so that errors grow without bound; shorten it, or ask to be shown the blow-up");
    }

    /// The exact flow of v̇ = a - η v over a time.
    void kick(double time, double eta, const Vector &a, Vector &v)
    {
      const double decay = std::exp(-eta * time);
      const double gain = eta == 0 ? time : -std::expm1(-eta * time) / eta;
      for (std::size_t i = 0; i < v.size(); ++i)
        v[i] = decay * v[i] + gain * a[i];
    }

    /// The same, and then a drift of u: vectors that do not fit a cache are read once.
    void kick_and_drift(double time, double eta, const Vector &a, double drift_time, State &state)
    {
      const double decay = std::exp(-eta * time);
      const double gain = eta == 0 ? time : -std::expm1(-eta * time) / eta;
      for (std::size_t i = 0; i < a.size(); ++i)
      {
        const double v = decay * state.v[i] + gain * a[i];
        state.v[i] = v;
        state.u[i] += drift_time * v;
      }
    }

    /// a(u, t) of a state that is known to have moved or not.
    class Acceleration
    {
    public:
      Acceleration(const Motion &motion, Counts &counts)
          : motion_(motion), counts_(counts), a_(motion.n)
      {
      }

      const Vector &at(const State &state)
      {
        if (!is_current_)
        {
          motion_.acceleration(state.u, state.t, a_);
          ++counts_.n_accelerations;
        }
        is_current_ = true;
        return a_;
      }
      void forget() { is_current_ = false; }
      Vector &values() { return a_; }

    private:
      const Motion &motion_;
      Counts &counts_;
      Vector a_;
      bool is_current_ = false;
    };

    void split_step(const Motion &motion, const Scheme &scheme, double step, State &state,
                    Acceleration &acceleration)
    {
      const auto &substeps = scheme.substeps;
      for (std::size_t i = 0; i < substeps.size(); ++i)
      {
        const double time = substeps[i].coefficient * step;
        const bool drifts_next = i + 1 < substeps.size() && !substeps[i + 1].is_kick;
        if (substeps[i].is_kick && !drifts_next)
        {
          kick(time, motion.damping, acceleration.at(state), state.v);
          continue;
        }
        double drift_time = time;
        if (substeps[i].is_kick)
        {
          drift_time = substeps[++i].coefficient * step;
          kick_and_drift(time, motion.damping, acceleration.at(state), drift_time, state);
        }
        else
          add(state.u, drift_time, state.v);
        state.t += drift_time;
        acceleration.forget();
      }
    }

    void explicit_step(const Motion &motion, double step, State &state, Acceleration &acceleration)
    {
      const Vector &a = acceleration.at(state);
      const Vector v = state.v;
      for (std::size_t i = 0; i < v.size(); ++i)
        state.v[i] += step * (a[i] - motion.damping * v[i]);
      add(state.u, step, v);
      acceleration.forget();
    }
  } // namespace

  Counts integrate(const Motion &motion, const Scheme &scheme, const Stepping &stepping, double end,
                   State &state, const Observer &observer)
  {
    check(motion, scheme, stepping, end, state);
    Counts counts;
    const double start = state.t;
    if (end == start)
      return counts;
    if (scheme.is_runge_kutta)
    {
      runge_kutta(motion, stepping, end, state, observer, counts);
      return counts;
    }
    const auto n_steps =
        static_cast<std::uint64_t>(std::ceil((end - start) / stepping.step * (1 - step_tolerance)));
    const double step = (end - start) / static_cast<double>(n_steps);
    Acceleration acceleration(motion, counts);
    for (std::uint64_t k = 1; k <= n_steps; ++k)
    {
      if (scheme.is_implicit())
      {
        acceleration.at(state);
        theta_step(motion, scheme.theta, step, stepping.tolerance, state, acceleration.values(),
                   counts);
      }
      else if (scheme.is_explicit_euler)
        explicit_step(motion, step, state, acceleration);
      else
        split_step(motion, scheme, step, state, acceleration);
      state.t = k == n_steps ? end : start + static_cast<double>(k) * step;
      counts.n_steps = k;
      if (!is_finite(state))
      {
        std::ostringstream message;
        message << "the motion is not finite any more after " << k << " steps, at t = " << state.t
                << "; the scheme " << scheme.name << " is unstable with Δt = " << step;
        throw NumericalError(message.str());
      }
      if (observer)
        observer(state);
    }
    return counts;
  }
} // namespace plumbline::analysis
