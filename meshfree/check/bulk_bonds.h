#pragma once

#include "meshfree/check/findings.h"

#include <functional>
#include <map>

namespace plumbline::meshfree
{
  /// What bonds are like in the bulk of a body, far from free surfaces and cracks: which pairs of
  /// nodes have a bond, and with which weight over the neighbour's volume. Bonds are alike that
  /// have one vector between their nodes, where vectors repeat as on lattices, or else one length,
  /// to an eighth of the nodes' spacing.
  class BulkBonds
  {
  public:
    struct Kind
    {
      std::size_t n_pairs = 0, n_bonds = 0; ///< pairs of nodes, and those that have a bond
      double ratio = 0;                     ///< median of weight / volume of the neighbour
      double deviation = 0;                 ///< most of them differ by no more, relative

      bool is_always_there() const;
    };

    /// By which the weight of a bond was multiplied.
    using Factor = std::function<double(std::size_t node, std::size_t neighbour)>;

    /// @param is_bulk  of each family
    /// @param spacing  of the nodes [length]
    BulkBonds(const GivenWeights<2> &given, const std::vector<char> &is_bulk, double spacing);

    /// The same bonds with a factor of their weights undone.
    BulkBonds without(const Factor &factor, const GivenWeights<2> &given,
                      const std::vector<char> &is_bulk) const;

    /// Null: there is no such bond in the bulk.
    const Kind *find(const Point<2> &xi) const;

    double reach() const { return reach_; } ///< the longest bond of the bulk [length]

  private:
    using Key = std::array<long long, 2>;

    Key key(const Point<2> &xi) const;
    void add_pairs(const GivenWeights<2> &given, const std::vector<char> &is_bulk);
    void add_bonds(const GivenWeights<2> &given, const std::vector<char> &is_bulk,
                   const Factor &factor);

    double spacing_, reach_ = 0;
    bool is_lattice_ = true;
    std::map<Key, Kind> kinds_;
  };
} // namespace plumbline::meshfree
