#pragma once

#include "algebra/spectrum.h"
#include "method/linear_equations.h"

#include <deal.II/base/point.h>

#include <vector>

namespace plumbline::method
{
  /// A discretisation's operator on its free unknowns, for spectra: Σ_j A_ij u_j = m_i b(x_i) and
  /// what the collar adds.
  template <int dim>
  struct DiscreteOperatorOf
  {
    unsigned int n_components = 1;
    std::vector<dealii::Point<dim>> nodes; ///< unknowns are numbered node by node
    std::vector<double> mass; ///< m of each node [length^dim], or 1 where all are alike; > 0
    /// Of one component on a lattice with one node a cell: -Σ_j A_ij (x_j - x_i)_1² / m_i over all
    /// neighbours of a node, in the collar too, and how far they are along an axis; else 0.
    double second_moment = 0, reach = 0;
    bool is_collocated = true; ///< row i states the equation at node i: no Galerkin method
    algebra::CsrMatrix rows;   ///< A; empty where only its action is there
    algebra::Action action;    ///< of a symmetric A, matrix-free; empty where only rows are there

    std::size_t size() const { return nodes.size() * n_components; }
  };

  using DiscreteOperator = DiscreteOperatorOf<2>;

  /// The operator of a sparse matrix, by its rows.
  /// @param of_unit_load  the equations with a load of 1 for each component, whose right-hand side
  /// is the mass where rows are tested by shape functions
  /// @throws NumericalError  a test function whose integral is not positive
  template <int dim>
  DiscreteOperatorOf<dim> discrete_operator(LinearEquations<dim> of_unit_load);
} // namespace plumbline::method
