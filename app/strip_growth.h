#pragma once

#include "meshfree/fracture/breaking_network.h"
#include "method/rice_strip.h"
#include "study/strip_growth.h"

namespace plumbline::app
{
  /// A crack that grows in a strip, of bonds of toughness G = 1.
  struct GrowingStrip
  {
    method::RiceStrip strip;    ///< with the crack that it begins with
    unsigned int n_columns = 4; ///< that are measured, after its first two
    physics::Lame lame;
    problem::SurfaceTerms surface_terms = problem::SurfaceTerms::uncorrected;
    meshfree::NeighbourhoodQuadrature rule; ///< of a rule, with the deviatoric kernel of μ = 1
    physics::Kernel<2> influence;
    geometry::Backend backend = geometry::Backend::fast;
  };

  /// What it needs and sets free; W1 is what the strip without surface terms gives for a column.
  /// @throws InputError, NumericalError  as make_bond_network, BreakingNetwork and measure_strip
  study::StripGrowth grow_through_strip(const GrowingStrip &strip);

  /// What study::run_growth and study::measure_strip take of a body.
  /// @param body  outlives it
  study::GrowthModel growth_model(meshfree::BreakingNetwork &body,
                                  const dealii::Point<2> &notch_tip);
} // namespace plumbline::app
