#include "analysis/integrate.h"

#include "algebra/simd.h"
#include "analysis/steps.h"
#include "base/error.h"

#include <algorithm>
#include <cmath>
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
    PLUMBLINE_WIDE_CLONES bool is_finite(const double *x, std::size_t n)
    {
      constexpr std::size_t n_sums = 8;
      double sums[n_sums] = {};
      for (std::size_t i = 0; i + n_sums <= n; i += n_sums)
        for (std::size_t l = 0; l < n_sums; ++l)
          sums[l] += 0 * x[i + l];
      for (std::size_t i = n / n_sums * n_sums; i < n; ++i)
        sums[0] += 0 * x[i];
      bool is = true;
      for (const double sum : sums)
        is = is && sum == 0;
      return is;
    }

    bool is_finite(const State &state)
    {
      return is_finite(state.u.data(), state.u.size()) && is_finite(state.v.data(), state.v.size());
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
      const bool has_limit = !scheme.is_runge_kutta && (!scheme.is_implicit() || scheme.theta < .5);
      if (scheme.is_runge_kutta && motion.changes)
        refuse("the scheme ", scheme.name,
               " chooses its own steps, and bonds cannot break between them; use velocity Verlet");
      if (stepping.critical_step && !stepping.shows_blow_up && has_limit &&
          stepping.step > *stepping.critical_step)
        refuse("time step = ", stepping.step, " is longer than the critical step ",
               *stepping.critical_step, " of the scheme ", scheme.name,
               ", so that errors grow without bound; shorten it, or ask to be shown the blow-up");
    }

    PLUMBLINE_WIDE_CLONES void add_kick(double decay, double time, const double *a, double *v,
                                        std::size_t n)
    {
      for (std::size_t i = 0; i < n; ++i)
        v[i] = decay * v[i] + time * a[i];
    }

    PLUMBLINE_WIDE_CLONES void add_drift(double time, const double *v, double *u, std::size_t n)
    {
      for (std::size_t i = 0; i < n; ++i)
        u[i] += time * v[i];
    }

    /// Accelerations, and the flows of split schemes. Kicks and drifts between two accelerations
    /// change each number by itself: they wait, and go over the vectors together, in blocks that
    /// fit a cache.
    class Flow
    {
    public:
      Flow(const Motion &motion, Counts &counts) : motion_(motion), counts_(counts), a_(motion.n) {}

      /// a(u, t) of a state that is known to have moved or not.
      const Vector &acceleration(State &state)
      {
        if (!is_current_)
        {
          apply(state);
          motion_.acceleration(state.u, state.t, a_);
          ++counts_.n_accelerations;
        }
        is_current_ = true;
        return a_;
      }
      void forget() { is_current_ = false; }
      Vector &values() { return a_; }

      /// The exact flow of v̇ = a - η v over a time.
      void kick(double time, State &state)
      {
        acceleration(state);
        const double eta = motion_.damping;
        waiting_.push_back(
            {true, std::exp(-eta * time), eta == 0 ? time : -std::expm1(-eta * time) / eta});
      }

      void drift(double time, State &state)
      {
        waiting_.push_back({false, 0, time});
        state.t += time;
        forget();
      }

      /// What waits. The acceleration is still that of the kicks among it.
      void apply(State &state)
      {
        constexpr std::size_t block = 1024;
        for (std::size_t begin = 0; begin < a_.size() && !waiting_.empty(); begin += block)
        {
          const std::size_t n = std::min(block, a_.size() - begin);
          double *const u = state.u.data() + begin, *const v = state.v.data() + begin;
          const double *const a = a_.data() + begin;
          for (const auto &[is_kick, decay, time] : waiting_)
            if (is_kick)
              add_kick(decay, time, a, v, n);
            else
              add_drift(time, v, u, n);
          is_finite_ = is_finite_ && is_finite(u, n) && is_finite(v, n);
        }
        waiting_.clear();
      }
      bool is_still_finite() const { return is_finite_; } ///< of what was applied

    private:
      struct Change
      {
        bool is_kick = false;
        double decay = 0, time = 0; ///< of a kick that by which a counts
      };
      const Motion &motion_;
      Counts &counts_;
      Vector a_;
      std::vector<Change> waiting_;
      bool is_current_ = false, is_finite_ = true;
    };

    void split_step(const Scheme &scheme, double step, State &state, Flow &flow)
    {
      for (const auto &[is_kick, coefficient] : scheme.substeps)
        if (is_kick)
          flow.kick(coefficient * step, state);
        else
          flow.drift(coefficient * step, state);
    }

    void explicit_step(const Motion &motion, double step, State &state, Flow &flow)
    {
      const Vector &a = flow.acceleration(state);
      const Vector v = state.v;
      for (std::size_t i = 0; i < v.size(); ++i)
        state.v[i] += step * (a[i] - motion.damping * v[i]);
      add(state.u, step, v);
      flow.forget();
    }
  } // namespace

  std::uint64_t n_equal_steps(double time, double step)
  {
    return static_cast<std::uint64_t>(std::ceil(time / step * (1 - step_tolerance)));
  }

  Counts integrate(const Motion &motion, const Scheme &scheme, const Stepping &stepping, double end,
                   State &state, const Observer &observer)
  {
    motion.ranks.together([&] { check(motion, scheme, stepping, end, state); });
    Counts counts;
    const double start = state.t;
    if (end == start)
      return counts;
    if (scheme.is_runge_kutta)
    {
      runge_kutta(motion, stepping, end, state, observer, counts);
      return counts;
    }
    const std::uint64_t n_steps = n_equal_steps(end - start, stepping.step);
    const double step = (end - start) / static_cast<double>(n_steps);
    Flow flow(motion, counts);
    const bool is_shared = motion.ranks.n_ranks() > 1;
    for (std::uint64_t k = 1; k <= n_steps; ++k)
    {
      if (scheme.is_implicit())
      {
        flow.acceleration(state);
        theta_step(motion, scheme.theta, step, stepping.tolerance, state, flow.values(), counts);
      }
      else if (scheme.is_explicit_euler)
        explicit_step(motion, step, state, flow);
      else
        split_step(scheme, step, state, flow);
      const bool is_split = !scheme.substeps.empty();
      if (is_split && (observer || motion.changes || k == n_steps))
        flow.apply(state);
      state.t = k == n_steps ? end : start + static_cast<double>(k) * step;
      counts.n_steps = k;
      const bool is_lost = is_split ? !flow.is_still_finite() : !is_finite(state);
      if (is_shared ? motion.ranks.any(is_lost) : is_lost)
      {
        std::ostringstream message;
        message << "the solution is not finite any more after " << k << " steps, at t = " << state.t
                << "; the scheme " << scheme.name << " is unstable with Δt = " << step;
        throw NumericalError(message.str());
      }
      if (observer)
        observer(state);
      if (motion.changes && motion.changes(state))
        flow.forget();
    }
    return counts;
  }
} // namespace plumbline::analysis
