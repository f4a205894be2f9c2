#pragma once

#include "meshfree/check/bond_pairs.h"

namespace plumbline::meshfree
{
  /// Nodes whose moments of degree 0 (of the weights), 1 or 2 (of w C) are inconsistent with those
  /// of the other nodes, and the one bond of each whose weight explains it, if one does; else the
  /// moments are what is named.
  /// @param pairs  from all_pairs
  std::vector<Outlier> find_moment_outliers(const GivenBonds &given,
                                            const std::vector<Pair> &pairs);
} // namespace plumbline::meshfree
