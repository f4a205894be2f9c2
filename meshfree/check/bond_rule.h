#pragma once

#include "geometry/node_cells.h"
#include "meshfree/rules/quadrature_rule.h"

#include <optional>

namespace plumbline::meshfree
{
  /// Weights and kernel points of another code, and the nodes they belong to.
  struct GivenBonds
  {
    const std::vector<Family> &families; ///< of the free nodes
    const Kernel<2> &kernel;
    const geometry::NodeCells &cells;   ///< of all nodes
    const std::vector<double> &volumes; ///< as given, of all nodes, numbered as the cells
  };

  /// Numbers that agree to so many digits count as the same: files are often written with six.
  constexpr double file_tolerance = 2e-5;

  /// The rule of ours that weights are, but for a common factor and some bonds.
  struct Recognised
  {
    std::string rule;
    double factor = 1;
    bool has_kernel_points = false; ///< those of the rule, too
    std::vector<Family> families;   ///< what the rule makes, its weights times the factor

    bool is_full_area() const; ///< whole cells, whatever part of them the horizon cuts off
  };

  /// What a rule makes of these nodes and volumes.
  /// @throws NumericalError  as Families::make
  std::vector<Family> rule_families(const std::string &name, const GivenBonds &given);

  /// Of all rules and counterexamples the one that most weights and kernel points agree with, nine
  /// of ten weights at least, relative to the neighbours' volumes and their √. Cost: .1 ms a node.
  std::optional<Recognised> recognise(const GivenBonds &given);
} // namespace plumbline::meshfree
