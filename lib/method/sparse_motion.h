#pragma once

#include "method/linear_motion.h"
#include "method/sparse_discretisation.h"

namespace plumbline::method
{
  /// What moves by sparse rows, on one rank.
  template <int dim>
  struct SparseParts
  {
    std::vector<dealii::Point<dim>> nodes; ///< that are free
    unsigned int n_components = 1;
    /// A of the equation M ü = load - A u: of free unknowns, kept only if it has no BlockRows, and
    /// of constrained ones.
    std::shared_ptr<const algebra::CsrMatrix> stiffness, constrained;
    std::vector<double> masses; ///< of each node; empty: `mass` is a matrix
    PartitionedRows mass;       ///< of all unknowns, by free and by constrained ones
    std::function<Vector(const problem::Problem<dim> &)> load; ///< M b
    std::function<std::vector<double>(const problem::Problem<dim> &)>
        around; ///< u of constrained unknowns
  };

  /// Whether A is symmetric is found out: to 1e-12 of its largest entry.
  /// Instantiated for dim = 2 and 3.
  /// @throws NumericalError  the mass matrix is not positive definite
  template <int dim>
  std::unique_ptr<MotionOf<dim>> move_by_rows(SparseParts<dim> parts);
} // namespace plumbline::method
