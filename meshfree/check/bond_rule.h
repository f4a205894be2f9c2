#pragma once

#include "geometry/node_cells.h"
#include "meshfree/check/precision.h"
#include "meshfree/rules/quadrature_rule.h"

#include <optional>

namespace plumbline::meshfree
{
  /// Weights and kernel points of another code, and the nodes they belong to.
  template <int dim>
  struct GivenBonds
  {
    const std::vector<Family<dim>> &families; ///< of the free nodes
    const Kernel<dim> &kernel;
    const geometry::NodeCells<dim> &cells; ///< of all nodes; may have no pieces in space
    const std::vector<double> &volumes;    ///< of all nodes, numbered as the cells
    Precision precision = {};
    Point<dim> origin = {}; ///< to which positions of the cells are relative, see GivenNodes
    double lattice = 0;     ///< spacing, if the nodes lie on a lattice of cubes; else 0 [length]
  };

  template <int dim>
  GivenBonds(const std::vector<Family<dim>> &, const Kernel<dim> &,
             const geometry::NodeCells<dim> &, const std::vector<double> &) -> GivenBonds<dim>;

  /// Calls visit(given bond or nullptr, bond of the rule or nullptr, neighbour) for the neighbours
  /// of either.
  template <int dim, class Visit>
  void for_both(const Family<dim> &given, const Family<dim> &rule, const Visit &visit)
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
  template <int dim>
  bool is_at_horizon(const GivenBonds<dim> &given, const Point<dim> &xi);

  /// The rule of ours that weights are, but for a common factor and some bonds.
  template <int dim>
  struct Recognised
  {
    std::string rule;
    double factor = 1;
    bool has_kernel_points = false;    ///< those of the rule, too
    std::vector<Family<dim>> families; ///< what the rule makes, its weights times the factor

    bool is_full_area() const; ///< whole cells, whatever part of them the horizon cuts off
  };

  /// What a rule makes of these nodes and volumes.
  /// @throws NumericalError  as Families::make
  template <int dim>
  std::vector<Family<dim>> rule_families(const std::string &name, const GivenBonds<dim> &given);

  /// Of all rules and counterexamples the one that most weights and kernel points agree with, nine
  /// of ten weights at least, relative to the neighbours' volumes and the sizes of their cells.
  /// Bonds as long as the horizon that only one of them has do not count. Cost: .1 ms a node in the
  /// plane.
  template <int dim>
  std::optional<Recognised<dim>> recognise(const GivenBonds<dim> &given);
} // namespace plumbline::meshfree
