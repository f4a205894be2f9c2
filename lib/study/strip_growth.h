#pragma once

#include "method/rice_strip.h"
#include "study/growth.h"

namespace plumbline::study
{
  /// How a crack grows through a strip in which it gets the energy W1 of the intact strip per
  /// length and load², by bonds of toughness G = 1.
  struct StripGrowth
  {
    double peak = 0; ///< largest W1 load² at which an event begins: what the crack needs to go on
    double mean = 0; ///< of the events
    double released = 0; ///< energy set free where each event happens at its own load, per length
    double bonds = 0;    ///< energy of broken bonds at their limits, per length
  };

  /// Of a crack's way [from, to) along x, whole columns of nodes; it stops there.
  /// @param W1  at load 1 [force/length]
  /// @throws NumericalError  the crack does not come so far
  StripGrowth measure_strip(const GrowthModel &strip, double W1, double from, double to);

  /// A crack that grows in a strip, of bonds of toughness G = 1.
  struct GrowingStrip
  {
    method::RiceStrip strip;    ///< with the crack that it begins with
    unsigned int n_columns = 4; ///< that are measured, after its first two
    physics::Lame lame;
    problem::SurfaceTerms surface_terms = problem::SurfaceTerms::uncorrected;
    geometry::Backend backend = geometry::Backend::fast;
  };

  /// What it needs and sets free; W1 is what the strip without surface terms gives for a column.
  /// Empty: the method's bodies have no bonds.
  /// @throws InputError, NumericalError  as of the bodies, and measure_strip
  std::optional<StripGrowth> grow_through_strip(const method::StripSolver &solver,
                                                const GrowingStrip &strip,
                                                const physics::Kernel<2> &influence);
} // namespace plumbline::study
