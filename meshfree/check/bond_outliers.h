#pragma once

#include "meshfree/check/bond_rule.h"

namespace plumbline::meshfree
{
  enum class Defect
  {
    weight,       ///< another weight than bonds like it have, or the rule gives it
    missing,      ///< no bond where others like it are
    spurious,     ///< a bond where others like it are none
    kernel_point, ///< the kernel taken elsewhere
    symmetry,     ///< w C / volume differs from end to end
    family,       ///< most weights of a node
    neighbour,    ///< most weights to a node, as if its volume were another
    volume,       ///< the volume of a node against its cell's area, or the others' volumes
    moments       ///< of a node, no bond of which is an outlier
  };

  /// One bond or node that is inconsistent with the others.
  template <int dim>
  struct Outlier
  {
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    Defect defect;
    std::size_t node, neighbour = none; ///< neighbour none: it is about the node
    std::size_t bond = none;            ///< its index in the family; none: there is none
    double found = 0, expected = 0; ///< weights, volumes [length^dim], w C / volume, or a moment
                                    ///< over its exact value
    Point<dim> found_point = {},
               expected_point = {}; ///< of the kernel, relative to the node [length]
    unsigned int degree = 0;        ///< of the moment
    double distance = 0;            ///< from what is usual, in what is allowed
    bool is_both_ways = false;      ///< missing in both families
  };

  /// Each quantity is held against its own spread over the bonds or nodes, see Spread; weights and
  /// kernel points against the rule where one is recognised. Nothing is said of nodes whose moments
  /// of degree 1 and 2 are exact, to rounding of the files, nor of bonds as long as the horizon
  /// that are there or not. The largest distance first.
  /// @param rule         empty: none is recognised
  /// @param point_scale  kernel points are expected at this fraction of the way to the neighbour
  /// Limits: a defect of the size of what differs from bond to bond anyway is not found; many
  /// defects of one kind (above one in 13) are no outliers. Cost: .2 ms a node, 3 kB a node.
  template <int dim>
  std::vector<Outlier<dim>> find_outliers(const GivenBonds<dim> &given,
                                          const std::optional<Recognised<dim>> &rule,
                                          double point_scale = 1);
} // namespace plumbline::meshfree
