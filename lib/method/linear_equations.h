#pragma once

#include "algebra/csr_matrix.h"

#include <deal.II/base/point.h>

#include <vector>

namespace plumbline::problem
{
  template <int dim>
  struct Problem;
}

namespace plumbline::method
{
  /// The static equations of a method, A u = load, with the columns of constrained nodes kept.
  /// Unknowns are numbered node by node: component c of node k is number k · n_components + c.
  template <int dim>
  struct LinearEquations
  {
    unsigned int n_components = 1;
    /// The free ones, in the order of Field::nodes, then constrained ones.
    std::vector<dealii::Point<dim>> nodes;
    std::size_t n_free = 0;
    algebra::CsrMatrix rows;        ///< A, shape (n_free, n_nodes) · n_components
    std::vector<double> load;       ///< b at the free nodes, or b tested by shape functions; shape
                                    ///< (n_free · n_components)
    std::vector<double> constraint; ///< u of the others, shape (n_constrained · n_components)
    /// Of the cells of free nodes [length^dim], where row i states the equation at node i; empty:
    /// rows are tested by shape functions.
    std::vector<double> volumes;
    bool has_quadrature_error = false; ///< entries are quadrature that statics refines
  };

  /// A discretisation whose equations have a sparse matrix.
  template <int dim>
  class HasLinearEquations
  {
  public:
    virtual ~HasLinearEquations() = default;

    /// On one rank.
    virtual LinearEquations<dim> equations(const problem::Problem<dim> &problem) const = 0;
  };
} // namespace plumbline::method
