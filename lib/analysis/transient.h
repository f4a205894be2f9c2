#pragma once

#include "analysis/integrate.h"
#include "analysis/time_series.h"
#include "method/equation_of_motion.h"

namespace plumbline::analysis
{
  /// All energies of a motion at a time [force length].
  struct Energies
  {
    double t = 0;
    double kinetic = 0, bond = 0;
    double work = 0;       ///< of load and constraint since the start
    double dissipated = 0; ///< by damping since the start

    double stored() const { return kinetic + bond; }
  };

  /// ρ ü = F(u) + g(t) - η ρ u̇ of a discretisation.
  class Transient
  {
  public:
    /// @param drive  g(t) from MotionOf::drive, including MotionOf::inertia for a manufactured
    /// motion
    /// @param equation  must outlive it
    Transient(const method::SemiDiscreteMotion &equation, TimeSeries drive, double density,
              double damping);

    /// For schemes; must not outlive this. Not for several threads at once.
    Motion motion() const;

    /// The longest step at which small motions about rest stay bounded, which holds for all states
    /// of bonds that only soften; infinite for schemes without one. From λ_max to 1e-4, found once.
    double critical_step(const Scheme &scheme) const;

    /// Of a state; work and dissipation are not known from it, and 0.
    Energies energies(const State &state) const;

    /// The rates of work and dissipation.
    std::pair<double, double> power(const State &state) const;

  private:
    double largest_squared_frequency() const;

    const method::SemiDiscreteMotion &equation_;
    TimeSeries drive_, rate_;
    double density_, damping_;
    mutable std::optional<double> largest_;
    mutable Vector g_; ///< of the last acceleration: tangents are about the same time
  };

  /// Energies over time: work and dissipation by the trapezoidal rule over the steps, so that their
  /// balance is off by O(Δt²), whatever the scheme.
  class EnergyLog
  {
  public:
    /// @param n_samples  that are kept, about
    EnergyLog(const Transient &transient, const State &start, std::uint64_t n_steps,
              std::uint64_t n_samples);

    /// After each step. @return whether this one was kept
    bool observe(const State &state);

    /// Bonds broke, so that the forces changed at the last state observed.
    void change(const State &state) { power_ = transient_.power(state); }

    const std::vector<Energies> &samples() const { return samples_; }

    /// max |stored + dissipated - work - what it began with| over the largest energy.
    double imbalance() const;

  private:
    const Transient &transient_;
    std::uint64_t interval_, n_seen_ = 0, n_steps_;
    double t_ = 0, work_ = 0, dissipated_ = 0;
    std::pair<double, double> power_;
    std::vector<Energies> samples_;
  };
} // namespace plumbline::analysis
