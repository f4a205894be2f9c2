#pragma once

#include "physics/regular_potential.h"
#include "reference/mesh/power_potential.h"

#include <optional>
#include <string>

namespace plumbline::reference
{
  /// The potential of a kernel without a horizon, of which the constant term is left out: of powers
  /// in closed form; of functions of |ξ|² by a table and a rule on each line, of others as powers.
  class WholePotential
  {
  public:
    /// @param farthest  points from each other [length]
    /// @param longest   line [length]
    /// @pre refuse is empty
    WholePotential(const physics::Kernel<2> &kernel, double farthest, double longest);

    /// Why a kernel's is not known; empty: it is.
    static std::string refuse(const physics::Kernel<2> &kernel, double farthest);

    /// A kernel without breaks as powers, functions to rounding up to a distance; nothing where
    /// that takes too many or they cancel each other.
    static std::optional<physics::Kernel<2>> as_powers(const physics::Kernel<2> &kernel,
                                                       double farthest);

    bool is_none() const { return powers_ && powers_->is_none(); }
    double constant() const { return powers_ ? powers_->constant() : 0; }

    /// See PowerPotential.
    PowerPotential::Entries integrate(const Vector2 &e, double from, double to, double h, double a,
                                      double b, bool for_divergence) const;

  private:
    double horizon_;
    std::optional<PowerPotential> powers_;
    std::optional<physics::RegularPotential> regular_;
    unsigned int n_points_ = 0; ///< of a rule on a line
  };
} // namespace plumbline::reference
