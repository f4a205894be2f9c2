#pragma once

#include "meshfree/rules/quadrature_rule.h"
#include "method/rice_strip.h"

namespace plumbline::meshfree
{
  /// Of a solid with λ = μ = 1, whose bonds are all of it; those that cross the crack are broken.
  /// @param rule       with the deviatoric kernel of μ = 1
  /// @param influence  1/r, ∫K|ξ|² = 2
  method::StripState solve_strip(const method::RiceStrip &strip,
                                 const NeighbourhoodQuadrature<2> &rule,
                                 const Kernel<2> &influence);
} // namespace plumbline::meshfree
