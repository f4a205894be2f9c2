#pragma once

#include "meshfree/check/bond_rule.h"

#include <string>

namespace plumbline::meshfree
{
  /// Something done to all weights or kernel points that explains the moments.
  struct Cause
  {
    std::string name; ///< in a word or two
    std::string text; ///< a sentence
    /// Median defect of the moments of degree 1 and 2 as given, and with the cause undone.
    double before = 0, after = 0;
    double factor = 1;         ///< the weights are the right ones times this
    bool is_own_error = false; ///< of a rule that is right for ever finer nodes
    double point_scale = 1;    ///< the kernel points are the right ones times this
  };

  /// Tries what other codes have been seen to do, each undone in turn: kernel points at the bond's
  /// midpoint, absolute, reversed, from the neighbour; weights negated, twice, half, with the
  /// volume of a ball (δ³) or the bond constant (δ⁴) of three dimensions in a plate of thickness h,
  /// scaled to the whole ball with the node's own volume, by another factor; whole cells where
  /// partial ones would do. A cause of weights counts if the moments are exact without it, or at
  /// least 4 times closer; of those that come as close the first in this order. One of kernel
  /// points counts if they lie 4 times nearer to the neighbours without it. Whole cells are a cause
  /// whatever the moments say where a rule with a ramp is meant, and FA is not, as long as the ramp
  /// changes the operator. Where none is meant the moments alone cannot tell: of kernels that fall
  /// to 0 at the horizon, FA's are as good as those of ramps, or better.
  /// @param rule   if one is recognised, a factor is that between the weights
  /// @param meant  names of rules that the weights are meant to be; empty: not known
  /// @return       none, one of each kind or both, that of the kernel points first
  std::vector<Cause> find_causes(const GivenBonds &given, const std::optional<Recognised> &rule,
                                 const std::vector<std::string> &meant = {});
} // namespace plumbline::meshfree
