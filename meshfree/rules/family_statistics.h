#pragma once

#include "base/communicator.h"
#include "geometry/node_cells.h"
#include "meshfree/rules/family_moments.h"
#include "meshfree/rules/quadrature_rule.h"
#include "method/diagnostics.h"

#include <optional>

namespace plumbline::meshfree
{
  /// Add a family to what a method says of its weights.
  template <int dim>
  void describe_weights(const std::vector<Bond<dim>> &family, const Fit &fit,
                        method::Diagnostics &diagnostics);

  /// What the families of scattered nodes are like.
  template <int dim>
  class FamilyStatistics
  {
  public:
    FamilyStatistics() = default;
    /// @param ball_order  see problem::MethodSettings
    FamilyStatistics(const geometry::NodeCells<dim> &cells, unsigned int ball_order);

    void add(const Kernel<dim> &kernel, const Point<dim> &node, const Family<dim> &family);

    /// The largest family, the distribution of moments, the smallest weight and the number of
    /// negative ones, with notes on how many families are concerned; over all ranks.
    /// @note Collective.
    method::Diagnostics diagnostics(const base::Communicator &communicator) const;

  private:
    method::Diagnostics weights_;
    bool is_scalar_ = true;
    unsigned int ball_order_ = 0;
    std::optional<BallMoments<dim>> second_, all_; ///< of the families' kernel, once there is one
    double worst_defect_ = 0, ball_defect_ = 0, area_defect_ = 0;
    MomentBias<dim> bias_;
    double n_families_ = 0, n_negative_ = 0, n_unstable_ = 0, n_dependent_ = 0, n_clipped_ = 0;
  };
} // namespace plumbline::meshfree
