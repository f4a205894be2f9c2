#pragma once

#include "base/communicator.h"
#include "meshfree/rules/quadrature_rule.h"
#include "method/diagnostics.h"

namespace plumbline::meshfree
{
  /// Add a family to what a method says of its weights.
  void describe_weights(const std::vector<Bond> &family, const Fit &fit,
                        method::Diagnostics &diagnostics);

  /// What the families of scattered nodes are like.
  class FamilyStatistics
  {
  public:
    void add(const Kernel<2> &kernel, const Family &family);

    /// The largest family, the distribution of moments, the smallest weight and the number of
    /// negative ones, with notes on how many families are concerned; over all ranks.
    /// @note Collective.
    method::Diagnostics diagnostics(const base::Communicator &communicator) const;

  private:
    method::Diagnostics weights_;
    bool is_scalar_ = true;
    double worst_defect_ = 0, ratio_ = 0,
           squared_ratio_ = 0; ///< of second moments, sums of the last
    double n_families_ = 0, n_negative_ = 0, n_unstable_ = 0, n_dependent_ = 0, n_clipped_ = 0;
  };
} // namespace plumbline::meshfree
