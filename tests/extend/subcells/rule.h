#pragma once

#include <meshfree/rules/rules.h>

namespace subcells
{
  /// The share of a cell that is in the ball by counting centres of 8 × 8 squares in the box of its
  /// pieces, kernel at the mean of those counted. Near to IPA-AC, without its geometry.
  plumbline::meshfree::NeighbourhoodQuadrature<2> rule(const plumbline::physics::Kernel<2> &kernel);
} // namespace subcells
