#pragma once

#include "geometry/for_each_index.h"
#include "method/discretisation_in_space.h"
#include "problem/in_space.h"

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

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

  /// Averages over the cells of Ω in planes that ranks want, from the ranks that have them.
  /// @param slabs   of cells
  /// @param own     this rank's, shape (n_cells, n_components)
  /// @param wanted  by each rank
  /// @note Collective.
  inline std::vector<double>
  fetch_averages(const geometry::CubeLattice &lattice, std::size_t n_components,
                 const base::Slabs &slabs, const std::vector<double> &own,
                 const std::function<base::Slabs::Range(unsigned int rank)> &wanted)
  {
    const auto &n = lattice.n_cells();
    const std::size_t of_plane = static_cast<std::size_t>(n[0]) * n[1] * n_components;
    if (lattice.is_box())
      return slabs.fetch(own, of_plane, wanted);
    // planes of the bounding box, with 0 in cells outside of Ω
    const auto place = [&](const std::array<int, 3> &cell, int first) {
      return lattice.number({cell[0], cell[1], cell[2] - first}) * n_components;
    };
    std::vector<double> planes(of_plane * slabs.n_owned()), result;
    auto average = own.begin();
    for_each_cell(lattice, slabs.owned(),
                  [&](const std::array<int, 3> &cell)
                  {
                    std::copy_n(average, n_components, &planes[place(cell, slabs.owned().first)]);
                    average += n_components;
                  });
    planes = slabs.fetch(planes, of_plane, wanted);
    const base::Slabs::Range mine = wanted(slabs.ranks().rank());
    for_each_cell(lattice, mine,
                  [&](const std::array<int, 3> &cell)
                  {
                    const double *const values = &planes[place(cell, mine.first)];
                    result.insert(result.end(), values, values + n_components);
                  });
    return result;
  }
} // namespace plumbline::study
