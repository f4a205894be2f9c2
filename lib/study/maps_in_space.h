#pragma once

#include "base/communicator.h"
#include "problem/in_space.h"
#include "study/results.h"

#include <vector>

// On several ranks each has the averages over the cells of its slab, see analysis::solve; all get
// the same pictures. Collective.
namespace plumbline::study
{
  /// Errors of averages in the three layers of cells through the middle, normal to z, y and x: the
  /// largest in each block of cells; and the solution's averages. Where a layer through the middle
  /// of the bounding box has no cell of Ω, the nearest one that has.
  /// @param averages, target  shape (n_cells, n_components)
  std::vector<ErrorMap> maps_of_layers(const problem::Problem<3> &problem,
                                       const base::Communicator &ranks,
                                       const std::vector<double> &averages,
                                       const std::vector<double> &target);

  /// The averages over every k-th cell along each axis, at most 12.
  SolutionGrid solution_grid(const problem::Problem<3> &problem, const base::Communicator &ranks,
                             const std::vector<double> &averages);
} // namespace plumbline::study
