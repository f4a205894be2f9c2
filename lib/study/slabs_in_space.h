#pragma once

#include "geometry/for_each_index.h"
#include "method/discretisation_in_space.h"
#include "problem/in_space.h"

// On several ranks each has the averages over the cells of its slab, see analysis::solve.
namespace plumbline::study
{
  /// visit(cell) for the cells of Ω in these planes, x fastest.
  template <class Visit>
  void for_each_cell(const geometry::CubeLattice &lattice, const base::Slabs::Range &planes,
                     const Visit &visit)
  {
    const auto &n = lattice.n_cells();
    geometry::for_each_index({0, 0, planes.first}, {n[0], n[1], planes.second},
                             [&](const std::array<int, 3> &cell)
                             {
                               if (lattice.is_inside(cell))
                                 visit(cell);
                             });
  }

  /// Values in a plane of cells that fills a box.
  inline std::size_t plane_size(const problem::Problem<3> &problem)
  {
    const auto &n = problem.lattice.n_cells();
    return static_cast<std::size_t>(n[0]) * n[1] * problem.n_components;
  }
} // namespace plumbline::study
