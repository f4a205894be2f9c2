#pragma once

#include "algebra/spectrum.h"
#include "base/slabs.h"
#include "method/equation_of_motion.h"
#include "method/mass_root.h"

#include <functional>
#include <optional>

namespace plumbline::method
{
  /// Nodes in planes that are distributed over ranks.
  struct NodeSlabs
  {
    base::Slabs slabs;
    std::size_t plane_size = 0; ///< nodes
  };

  /// The parts of a linear equation of motion M ü = load - A u.
  template <int dim>
  struct LinearParts
  {
    using State = SemiDiscreteMotion::State;
    using Driven = std::function<State(const problem::Problem<dim> &)>;

    std::vector<dealii::Point<dim>> nodes; ///< that are free
    unsigned int n_components = 1;
    std::vector<std::size_t> place; ///< of values counted node by node; empty: unknowns are, too
    MassRoot mass;
    algebra::Action stiffness;       ///< A
    algebra::Action transposed = {}; ///< Aᵀ where A is not symmetric
    Driven load;                     ///< M b, less what constrained nodes add to A u
    Driven inertia;  ///< M u of the solution and of constrained nodes: u stands for ü
    double unit = 1; ///< that masses are counted in [length^dim]
    /// Where ranks share it: all of these are this rank's then, vectors of unknowns have shape
    /// (n_components, n_nodes), and the motion is a DistributedMotion.
    std::optional<NodeSlabs> distribution = {};
  };

  /// States are Sᵀ u with M = S Sᵀ, so that the tangent of a symmetric A is symmetric.
  /// Where A is not symmetric the tangent is that of its symmetric part, whose largest eigenvalue
  /// bounds the real parts of A's; the energy is that part's too, and the rest disturbs its
  /// balance.
  /// Instantiated for dim = 2 and 3.
  template <int dim>
  std::unique_ptr<MotionOf<dim>> move_linear(LinearParts<dim> parts);
} // namespace plumbline::method
