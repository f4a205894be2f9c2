#pragma once

#include "meshfree/fracture/bond_network.h"

namespace plumbline::meshfree
{
  /// Rice's strip: endless, between rigid grips that move apart by 2 at load 1, with a crack along
  /// its middle that comes from the left without end. Away from both ends a crack that advances
  /// turns the intact strip into two that nothing strains, so that it gets the energy W1 of the
  /// intact strip per length, whatever the horizon.
  /// Source: Rice 1968, doi:10.1115/1.3601206.
  struct RiceStrip
  {
    int n_height = 0, n_length = 0; ///< rows between the grips, columns
    int n_crack = 0;                ///< columns that are cut, at the left
    double h = 0;
  };

  /// @param horizon  the grips' thickness at least, twice as thick for dilatations
  BreakingSolid make_strip(const RiceStrip &strip, const physics::Lame &lame, double horizon);
} // namespace plumbline::meshfree
