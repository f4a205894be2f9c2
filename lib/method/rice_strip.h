#pragma once

#include "geometry/ball_cell.h"
#include "method/breakable_body.h"
#include "physics/kernel.h"
#include "physics/state_based.h"
#include "problem/surface_terms.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace plumbline::method
{
  /// Rice's strip: endless, between rigid grips that move apart by 2 at load 1, with a crack along
  /// its middle that comes from the left without end. Away from both ends a crack that advances
  /// turns the intact strip into two that nothing strains, so that it gets the energy W1 of the
  /// intact strip per length, whatever the horizon.
  /// Source: Rice 1968, doi:10.1115/1.3601206.
  struct RiceStrip
  {
    int n_height = 0, n_length = 0; ///< rows between the grips, even; columns
    int n_crack = 0;                ///< columns that are cut, at the left
    double h = 0;                   ///< [length]

    /// Instead, what is around the strip is constrained at the field of a crack at K = 1 whose tip
    /// is so many columns from the left, see physics::crack_field. Its advance gets K²/E' as h and
    /// the horizon vanish.
    std::optional<double> K_tip = {};
  };

  /// A strip of bonds with λ = μ = 1 in equilibrium at load 1. Between grips what is behind its
  /// left end moves with them, and what is ahead of its right end is the intact strip. Energies [μ
  /// length²], of the intact strip per length [μ length].
  struct StripState
  {
    double energy = 0;           ///< Π of all bonds with an end between the grips and both ends
    double intact = 0;           ///< W1; in a field of K: K²/E'
    double at_end = 0;           ///< half of the intact strip's bonds that cross a line x = const
    std::vector<double> opening; ///< jump of u_y across the crack at the right of each column that
                                 ///< it cuts; of rules, at its nodes [length]
    std::size_t n_unknowns = 0;

    /// What the tip adds to an intact strip from there on: it depends on neither end.
    double tip_energy(const RiceStrip &strip) const
    {
      return energy - intact * strip.h * (strip.n_length - strip.n_crack) - at_end;
    }
  };

  /// What solves such strips, of bonds 8 μ K ξ⊗ξ/|ξ|².
  class StripSolver
  {
  public:
    virtual ~StripSolver() = default;

    /// @param influence  K, ∫K|ξ|² = 2
    /// @throws NumericalError  weights are infeasible
    virtual StripState solve_strip(const RiceStrip &strip,
                                   const physics::Kernel<2> &influence) const = 0;

    /// The strip as a body whose bonds, of toughness G = 1, can break; empty: the method has none.
    virtual std::optional<BreakableBody<2>>
    breakable_strip(const RiceStrip & /*strip*/, const physics::Lame & /*lame*/,
                    problem::SurfaceTerms /*terms*/, const physics::Kernel<2> & /*influence*/,
                    geometry::Backend /*backend*/) const
    {
      return {};
    }
  };
} // namespace plumbline::method
