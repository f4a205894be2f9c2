#pragma once

#include "meshfree/check/bond_outliers.h"

namespace plumbline::meshfree
{
  /// Weights that are not the rule's, bonds that it does not have or that are missing, and kernel
  /// points that are not its, where most are. Bonds as long as the horizon may be there or not.
  template <int dim>
  std::vector<Outlier<dim>> compare_with_rule(const GivenBonds<dim> &given,
                                              const Recognised<dim> &rule);
} // namespace plumbline::meshfree
