#pragma once

#include "geometry/node_cells.h"
#include "method/sparse_motion.h"

namespace plumbline::meshfree
{
  /// Rows are equations at nodes; by volumes they are the balance of forces on cells, symmetric
  /// where bonds have one weight.
  template <int dim>
  algebra::CsrMatrix by_volumes(algebra::CsrMatrix rows, const geometry::NodeCells<dim> &cells,
                                unsigned int n_components);

  /// Linear motions of scattered nodes, each with the mass of its cell.
  /// @param free, constrained  columns of the rows of free unknowns
  /// @param around             u of constrained unknowns
  /// Instantiated for dim = 2 and 3.
  template <int dim>
  std::unique_ptr<method::MotionOf<dim>>
  move_nodes(std::shared_ptr<const geometry::NodeCells<dim>> cells, unsigned int n_components,
             const algebra::CsrMatrix &free, const algebra::CsrMatrix &constrained,
             std::function<std::vector<double>(const problem::Problem<dim> &)> around);
} // namespace plumbline::meshfree
