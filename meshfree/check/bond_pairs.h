#pragma once

#include "meshfree/check/bond_outliers.h"

namespace plumbline::meshfree
{
  /// A free node and another one within reach of its bonds.
  template <int dim>
  struct Pair
  {
    std::size_t node = 0, neighbour = 0;
    std::size_t bond = 0; ///< index into the node's family; Outlier::none: there is none
    Point<dim> xi;        ///< [length]
  };

  /// √, in space ∛, of the mean area or volume of the free nodes' cells [length].
  template <int dim>
  double node_size(const GivenBonds<dim> &given);

  /// All bonds, and all pairs without a bond that are no longer than most bonds and a half cell.
  template <int dim>
  std::vector<Pair<dim>> all_pairs(const GivenBonds<dim> &given);

  template <int dim>
  inline const Bond<dim> &bond_of(const GivenBonds<dim> &given, const Pair<dim> &pair)
  {
    return given.families[pair.node].bonds[pair.bond];
  }

  /// Of each pair's weight to its neighbour's volume; 0 where there is no bond.
  template <int dim>
  std::vector<double> weights_over_volumes(const GivenBonds<dim> &given,
                                           const std::vector<Pair<dim>> &pairs);
} // namespace plumbline::meshfree
