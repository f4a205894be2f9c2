#pragma once

#include "algebra/operator.h"
#include "method/equation_of_motion.h"

#include <functional>

namespace plumbline::method
{
  /// The parts of an equation of motion on a lattice by one stencil: M ü = load - A u, M that of
  /// Galerkin methods or a number.
  struct LatticeParts
  {
    const geometry::Lattice &lattice;
    const geometry::NodeSet &nodes;
    algebra::Stencil stiffness, mass;
    algebra::OperatorBackend backend;
    /// M b over the nodes, 0 where they are not free. Must stay valid.
    std::function<algebra::Vector(const problem::Problem<2> &)> load;
    double cell = 1; ///< of a node where M is a number: kinetic energies are sums over these
                     ///< [length^2]
  };

  /// States are L^T u with M = L L^T by a sparse Cholesky factor, or √m u where M is diagonal, so
  /// that the tangent is symmetric; M is solved with exactly, to round-off.
  /// @throws NumericalError  M is not positive definite
  std::unique_ptr<EquationOfMotion> move_on_lattice(LatticeParts parts);

  /// The constraint at all positions within `margin` of the bounding box that are not free, 0 where
  /// they are: shape (n_blocks, n[1] + 2 margin, n[0] + 2 margin).
  /// @param constrained  if given: where those that are not free stand, component by component
  std::vector<double> collar_values(const problem::Problem<2> &problem,
                                    const geometry::NodeSet &nodes, int margin,
                                    std::vector<std::size_t> *constrained = nullptr);
} // namespace plumbline::method
