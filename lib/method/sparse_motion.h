#pragma once

#include "method/linear_motion.h"
#include "method/sparse_discretisation.h"

namespace plumbline::method
{
  /// What moves by sparse rows, on one rank.
  struct SparseParts
  {
    std::vector<dealii::Point<2>> nodes; ///< that are free
    unsigned int n_components = 1;
    /// A of the equation M ü = load - A u; must stay valid.
    const algebra::CsrMatrix &stiffness, &constrained;
    std::vector<double> masses; ///< of each node; empty: `mass` is a matrix
    PartitionedRows mass;       ///< of all unknowns, by free and by constrained ones
    std::function<Vector(const problem::Problem<2> &)> load; ///< M b
    std::function<std::vector<double>(const problem::Problem<2> &)>
        around; ///< u of constrained unknowns
  };

  /// Whether A is symmetric is found out: to 1e-12 of its largest entry.
  /// @throws NumericalError  the mass matrix is not positive definite
  std::unique_ptr<EquationOfMotion> move_by_rows(SparseParts parts);
} // namespace plumbline::method
