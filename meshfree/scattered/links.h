#pragma once

#include "meshfree/scattered/state_based_operator.h"

#include <deal.II/base/array_view.h>

namespace plumbline::meshfree
{
  /// A bond of a state-based body.
  struct Link
  {
    unsigned int node = 0; ///< at its other end
    bool is_intact = false;
    double strength = 0; ///< w K
    Tensor<1, 2> xi, direction;
  };

  /// The families of a share of Ω and of the nodes that it reaches.
  class Links
  {
  public:
    /// @throws as state_based_operator
    Links(const FamilySource<2> &families, const StateBasedBody &body,
          std::pair<std::size_t, std::size_t> share);

    bool has(std::size_t node) const { return nodes_[node].last > nodes_[node].first; }
    bool is_whole(std::size_t node) const { return nodes_[node].is_whole; }
    const Remainder &remainder(std::size_t node) const { return nodes_[node].remainder; }

    dealii::ArrayView<const Link> of(std::size_t node) const
    {
      return {links_.data() + nodes_[node].first, nodes_[node].last - nodes_[node].first};
    }

    /// θ = Σ g·(u_j - u_i).
    Tensor<1, 2> gradient(std::size_t node, const Link &link) const
    {
      return link.strength * (nodes_[node].remainder.correction * link.xi);
    }

    const FamilyStatistics<2> &statistics() const { return statistics_; } ///< of the share

  private:
    struct Node
    {
      std::size_t first = 0, last = 0; ///< of its links
      Remainder remainder;
      bool is_whole = true; ///< no bond of it is broken
    };

    std::vector<Node> nodes_;
    std::vector<Link> links_;
    FamilyStatistics<2> statistics_;
  };
} // namespace plumbline::meshfree
