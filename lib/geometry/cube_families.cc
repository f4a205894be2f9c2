#include "geometry/cube_families.h"

#include <algorithm>
#include <utility>

namespace plumbline::geometry
{
  std::size_t CubeFamilies::n_free() const
  {
    return is_free.size() - std::count(is_free.begin(), is_free.end(), 0);
  }

  std::array<unsigned int, 3> CubeFamilies::along(unsigned int family) const
  {
    const auto n_axis = static_cast<unsigned int>(axis.size());
    return {family % n_axis, family / n_axis % n_axis, family / n_axis / n_axis};
  }

  std::vector<std::size_t> CubeFamilies::free_places() const
  {
    std::vector<std::size_t> places;
    for (unsigned int c = 0; c < n_components; ++c)
      for (std::size_t i = 0; i < is_free.size(); ++i)
        if (is_free[i] != 0)
          places.push_back(c * is_free.size() + i);
    return places;
  }

  CubeFamilies free_families(const CubeLattice &lattice, std::vector<AxisSpecies> axis,
                             unsigned int n_components)
  {
    CubeFamilies nodes{std::move(axis), n_components, lattice.n_cells(), {}};
    for (unsigned int family = 0; family < nodes.n_families(); ++family)
    {
      std::array<int, 3> n_below{}; // cells of the support before the family's own
      for (unsigned int d = 0; d < 3; ++d)
        n_below[d] = nodes.axis[nodes.along(family)[d]].at_vertex ? 1 : 0;
      for_each_index({0, 0, 0}, nodes.n,
                     [&](const std::array<int, 3> &at)
                     {
                       bool is_free = true;
                       for_each_index({at[0] - n_below[0], at[1] - n_below[1], at[2] - n_below[2]},
                                      {at[0] + 1, at[1] + 1, at[2] + 1},
                                      [&](const std::array<int, 3> &cell)
                                      { is_free = is_free && lattice.is_inside(cell); });
                       nodes.is_free.push_back(is_free ? 1 : 0);
                     });
    }
    return nodes;
  }
} // namespace plumbline::geometry
