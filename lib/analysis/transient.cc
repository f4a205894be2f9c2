#include "analysis/transient.h"

#include "analysis/critical_step.h"
#include "method/distributed_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plumbline::analysis
{
  Transient::Transient(const method::SemiDiscreteMotion &equation, TimeSeries drive, double density,
                       double damping)
      : equation_(equation), drive_(std::move(drive)), rate_(drive_.derivative()),
        density_(density), damping_(damping), g_(drive_.at(0))
  {
  }

  Motion Transient::motion() const
  {
    Motion motion;
    motion.n = equation_.size();
    motion.damping = damping_;
    motion.ranks = method::ranks_of(equation_);
    motion.acceleration = [this](const Vector &u, double t, Vector &a)
    {
      drive_.at(t, g_);
      equation_.acceleration(u, g_, a);
      for (double &value : a)
        value /= density_;
    };
    if (equation_.has_tangent() && equation_.is_symmetric())
      motion.tangent = [this](const Vector &u, const Vector &v, Vector &out)
      {
        equation_.tangent(u, g_, v, out);
        for (double &value : out)
          value /= density_;
      };
    return motion;
  }

  double Transient::critical_step(const Scheme &scheme) const
  {
    const double limit = stability_limit(scheme);
    if (!std::isfinite(limit) || limit == 0)
      return limit;
    if (!largest_)
      largest_ = largest_squared_frequency();
    return *largest_ > 0 ? limit / std::sqrt(*largest_) : std::numeric_limits<double>::infinity();
  }

  double Transient::largest_squared_frequency() const
  {
    if (const auto known = equation_.largest_eigenvalue())
      return *known / density_;
    if (!equation_.has_tangent())
      return 0;
    const Vector rest(equation_.size()), nothing(g_.size());
    const auto stiffness = [&](const Vector &x, Vector &y)
    {
      equation_.tangent(rest, nothing, x, y);
      for (double &value : y)
        value = -value;
    };
    constexpr double tolerance = 1e-4;
    Parts parts;
    if (const auto *const shared = method::distributed(equation_))
      parts = {shared->ranks(), [shared](std::size_t i) { return shared->number(i); }};
    return largest_eigenvalue(stiffness, equation_.size(), tolerance, parts) / density_;
  }

  Energies Transient::energies(const State &state) const
  {
    Energies energies;
    energies.t = state.t;
    energies.kinetic = .5 * density_ * equation_.product(state.v, state.v);
    energies.bond = equation_.energy(state.u, drive_.at(state.t));
    return energies;
  }

  std::pair<double, double> Transient::power(const State &state) const
  {
    return {equation_.power(state.u, state.v, drive_.at(state.t), rate_.at(state.t)),
            damping_ * density_ * equation_.product(state.v, state.v)};
  }

  EnergyLog::EnergyLog(const Transient &transient, const State &start, std::uint64_t n_steps,
                       std::uint64_t n_samples)
      : transient_(transient),
        interval_(std::max<std::uint64_t>(1, n_steps / std::max<std::uint64_t>(1, n_samples))),
        n_steps_(n_steps), t_(start.t),
        power_(transient.power(start)), samples_{transient.energies(start)}
  {
  }

  bool EnergyLog::observe(const State &state)
  {
    const auto power = transient_.power(state);
    const double step = state.t - t_;
    work_ += .5 * step * (power_.first + power.first);
    dissipated_ += .5 * step * (power_.second + power.second);
    t_ = state.t;
    power_ = power;
    if (++n_seen_ % interval_ != 0 && n_seen_ != n_steps_)
      return false;
    samples_.push_back(transient_.energies(state));
    samples_.back().work = work_;
    samples_.back().dissipated = dissipated_;
    return true;
  }

  double EnergyLog::imbalance() const
  {
    double largest = 0, size = 0;
    for (const Energies &now : samples_)
    {
      largest = std::max(
          largest, std::abs(now.stored() + now.dissipated - now.work - samples_.front().stored()));
      size = std::max({size, now.kinetic, now.bond, std::abs(now.work), now.dissipated});
    }
    return size > 0 ? largest / size : 0;
  }
} // namespace plumbline::analysis
