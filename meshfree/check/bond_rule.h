#pragma once

#include "geometry/node_cells.h"
#include "meshfree/check/precision.h"
#include "meshfree/rules/quadrature_rule.h"

#include <optional>

namespace plumbline::meshfree
{
  /// Weights and kernel points of another code, and the nodes they belong to.
  struct GivenBonds
  {
    const std::vector<Family<2>> &families; ///< of the free nodes
    const Kernel<2> &kernel;
    const geometry::NodeCells<2> &cells; ///< of all nodes
    const std::vector<double> &volumes;  ///< of all nodes, numbered as the cells
    Precision precision = {};
    Point<2> origin = {}; ///< that the places of the cells count from, see GivenNodes
  };

  /// Calls visit(given bond or nullptr, bond of the rule or nullptr, neighbour) for the neighbours
  /// of either.
  template <class Visit>
  void for_both(const Family<2> &given, const Family<2> &rule, const Visit &visit)
  {
    std::size_t a = 0, b = 0;
    while (a < given.bonds.size() || b < rule.bonds.size())
    {
      const bool has_a = a < given.bonds.size(), has_b = b < rule.bonds.size();
      const bool takes_a = has_a && (!has_b || given.neighbours[a] <= rule.neighbours[b]),
                 takes_b = has_b && (!has_a || rule.neighbours[b] <= given.neighbours[a]);
      const std::size_t j = takes_a ? given.neighbours[a] : rule.neighbours[b];
      visit(takes_a ? &given.bonds[a++] : nullptr, takes_b ? &rule.bonds[b++] : nullptr, j);
    }
  }

  /// Whether a bond is as long as the horizon, to the rounding of the nodes' places. Codes take
  /// such bonds or leave them out, r <= horizon or r < horizon, and rounding may decide.
  bool is_at_horizon(const GivenBonds &given, const Point<2> &xi);

  /// The rule of ours that weights are, but for a common factor and some bonds.
  struct Recognised
  {
    std::string rule;
    double factor = 1;
    bool has_kernel_points = false;  ///< those of the rule, too
    std::vector<Family<2>> families; ///< what the rule makes, its weights times the factor

    bool is_full_area() const; ///< whole cells, whatever part of them the horizon cuts off
  };

  /// What a rule makes of these nodes and volumes.
  /// @throws NumericalError  as Families::make
  std::vector<Family<2>> rule_families(const std::string &name, const GivenBonds &given);

  /// Of all rules and counterexamples the one that most weights and kernel points agree with, nine
  /// of ten weights at least, relative to the neighbours' volumes and their √. Bonds as long as the
  /// horizon that one of both lacks do not count. Cost: .1 ms a node.
  std::optional<Recognised> recognise(const GivenBonds &given);
} // namespace plumbline::meshfree
