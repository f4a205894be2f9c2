#pragma once

#include "meshfree/fracture/bond_network.h"
#include "method/rice_strip.h"

namespace plumbline::meshfree
{
  /// Its ends are free.
  /// @param horizon  the grips' thickness at least, twice as thick for dilatations
  BreakingSolid<2> make_strip(const method::RiceStrip &strip, const physics::Lame &lame,
                              double horizon);
} // namespace plumbline::meshfree
