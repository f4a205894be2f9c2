#pragma once

#include "algebra/operator.h"
#include "study/method.h"

namespace plumbline::study
{
  /// The solution of a translation-invariant problem on a lattice, as both sides need it.
  struct LatticeSolve
  {
    /// Solution and, around it, the constraint, at positions -1 ... n of each axis: shape
    /// (n_blocks, n[1] + 2, n[0] + 2).
    std::vector<double> values;
    base::Cost cost; ///< operator and solver; what came before is the caller's to add
    Diagnostics diagnostics;
  };

  /// Solve stencil u = load on the free nodes, with u given by the problem's constraint elsewhere.
  /// @param load  right-hand side over the nodes, without the collar
  /// @throws NumericalError  an operator that is not positive definite, no convergence
  LatticeSolve solve_on_lattice(const scene::Scene &scene, const scene::Problem &problem,
                                const geometry::NodeSet &nodes, const algebra::Stencil &stencil,
                                const std::function<algebra::Vector()> &load);

  /// Memory of such a solution at its peak [bytes]: vectors, symbols of transforms on lengths that
  /// the reach pads, the stencil and a family. Measured on 13 methods and scenes: .6 to 1.2 of it.
  /// @param n_families  of nodes on each cell
  /// @param reach       of the stencil [cells]
  double expected_lattice_bytes(const ProblemSize &size, unsigned int n_families,
                                unsigned int n_components, double reach);

  /// Show a stencil on the free nodes: its action, and its rows up to 2e7 entries.
  /// @param mass  of the nodes of each family
  DiscreteOperator show_on_lattice(const geometry::Lattice &lattice, const geometry::NodeSet &nodes,
                                   const algebra::Stencil &stencil,
                                   const std::vector<double> &mass);
} // namespace plumbline::study
