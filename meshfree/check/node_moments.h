#pragma once

#include "meshfree/check/bond_pairs.h"

namespace plumbline::meshfree
{
  /// Nodes whose moments of degree 0 (of the weights), 1 or 2 (of w C) are inconsistent with those
  /// of the other nodes, and the one bond of each whose weight explains it, if one does; else the
  /// moments are what is named.
  /// @param pairs  from all_pairs
  template <int dim>
  std::vector<Outlier<dim>> find_moment_outliers(const GivenBonds<dim> &given,
                                                 const std::vector<Pair<dim>> &pairs);
} // namespace plumbline::meshfree
