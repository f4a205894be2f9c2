#pragma once

#include "meshfree/check/bond_outliers.h"

namespace plumbline::meshfree
{
  /// A free node and another one within reach of its bonds.
  struct Pair
  {
    std::size_t node = 0, neighbour = 0;
    std::size_t bond = 0; ///< index into the node's family; Outlier::none: there is none
    Point<2> xi;          ///< [length]
  };

  /// √ of the mean area of the free nodes' cells [length].
  double node_size(const GivenBonds &given);

  /// All bonds, and all pairs without a bond that are no longer than most bonds and a half cell.
  std::vector<Pair> all_pairs(const GivenBonds &given);

  inline const Bond<2> &bond_of(const GivenBonds &given, const Pair &pair)
  {
    return given.families[pair.node].bonds[pair.bond];
  }

  /// Of each pair's weight to its neighbour's volume; 0 where there is no bond.
  std::vector<double> weights_over_volumes(const GivenBonds &given, const std::vector<Pair> &pairs);
} // namespace plumbline::meshfree
