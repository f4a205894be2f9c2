#pragma once

#include "meshfree/check/bond_pairs.h"
#include "meshfree/check/bond_profile.h"

namespace plumbline::meshfree
{
  /// Nodes all weights to which, or from which, carry a factor of their own: Defect::neighbour or
  /// Defect::family, `found` is the factor. Of each node the median over its bonds of weight /
  /// volume against what is usual at their length is held against those of the other nodes, so that
  /// a factor shows that is lost among the differences of the weights themselves.
  /// Limits: of nodes with four bonds at least whose length is out of the range where weights fall
  /// off to 0, and of factors beyond 1.25, or more where weights differ from node to node anyway.
  template <int dim>
  std::vector<Outlier<dim>> find_scaled_nodes(const GivenBonds<dim> &given,
                                              const std::vector<Pair<dim>> &pairs,
                                              const BondProfile &profile);

  /// The families with the weights of such nodes divided by their factors.
  template <int dim>
  std::vector<Family<dim>> without_factors(std::vector<Family<dim>> families,
                                           const std::vector<Outlier<dim>> &scaled);
} // namespace plumbline::meshfree
