#include "study/maps_in_space.h"

#include "base/number_text.h"
#include "study/comparison.h"
#include "study/slabs_in_space.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

namespace plumbline::study
{
  namespace
  {
    using ProblemInSpace = problem::Problem<3>;
    using base::Communicator;

    constexpr double nothing = -1; ///< less than every error

    /// visit(cell, place of its first average) for this rank's cells.
    template <class Visit>
    void for_each_own_cell(const ProblemInSpace &problem, const Communicator &ranks,
                           const Visit &visit)
    {
      std::size_t place = 0;
      for_each_cell(problem.lattice, method::slabs_of_cells(problem.lattice, ranks).owned(),
                    [&](const std::array<int, 3> &cell)
                    {
                      visit(cell, place);
                      place += problem.n_components;
                    });
    }

    /// The layer of cells normal to an axis nearest to the middle that has cells of Ω.
    int middle_layer(const geometry::CubeLattice &lattice, unsigned int axis)
    {
      const int middle = lattice.n_cells()[axis] / 2;
      if (lattice.is_box())
        return middle;
      int nearest = -1;
      lattice.for_each_cell(
          [&](const std::array<int, 3> &cell)
          {
            const int distance = std::abs(cell[axis] - middle);
            if (nearest < 0 || distance < std::abs(nearest - middle))
              nearest = cell[axis];
          });
      return nearest;
    }

    ErrorMap map_of_layer(unsigned int normal, const ProblemInSpace &problem,
                          const Communicator &ranks, const std::vector<double> &averages,
                          const std::vector<double> &target)
    {
      constexpr int n_digits = 4;
      const std::string names = "xyz";
      const unsigned int across = normal == 0 ? 1 : 0, up = normal == 2 ? 1 : 2;
      const geometry::CubeLattice &lattice = problem.lattice;
      const auto &n = lattice.n_cells();
      const int layer = middle_layer(lattice, normal);
      const int per_block = cells_per_block({n[across], n[up]});
      ErrorMap map;
      map.quantity = std::string("averages at ") + names[normal] + " = " +
                     base::to_text(lattice.coordinate(normal, layer + .5), n_digits);
      map.axes = {names[across], names[up]};
      map.h = problem.h();
      map.horizon = problem.horizon();
      map.n_x = (n[across] + per_block - 1) / per_block;
      map.n_y = (n[up] + per_block - 1) / per_block;
      map.lower = {lattice.coordinate(across, 0), lattice.coordinate(up, 0)};
      map.upper = {lattice.coordinate(across, per_block * static_cast<double>(map.n_x)),
                   lattice.coordinate(up, per_block * static_cast<double>(map.n_y))};
      map.n_components = problem.n_components;
      map.values.assign(std::size_t{map.n_x} * map.n_y, nothing);
      BlockMeans means(map.values.size());
      for_each_own_cell(
          problem, ranks,
          [&](const std::array<int, 3> &cell, std::size_t place)
          {
            if (cell[normal] != layer)
              return;
            const std::size_t block =
                static_cast<std::size_t>(cell[up] / per_block) * map.n_x + cell[across] / per_block;
            means.add(block, &averages[place], problem.n_components);
            for (unsigned int c = 0; c < problem.n_components; ++c)
              map.values[block] =
                  std::fmax(map.values[block], std::abs(averages[place + c] - target[place + c]));
          });
      dealii::Utilities::MPI::max(map.values, ranks.mpi, map.values);
      std::replace(map.values.begin(), map.values.end(), nothing,
                   std::numeric_limits<double>::quiet_NaN());
      map.solution = means.means(ranks);
      return map;
    }
  } // namespace

  std::vector<ErrorMap> maps_of_layers(const ProblemInSpace &problem, const Communicator &ranks,
                                       const std::vector<double> &averages,
                                       const std::vector<double> &target)
  {
    std::vector<ErrorMap> maps;
    for (const unsigned int normal : {2u, 1u, 0u})
      maps.push_back(map_of_layer(normal, problem, ranks, averages, target));
    return maps;
  }

  SolutionGrid solution_grid(const ProblemInSpace &problem, const Communicator &ranks,
                             const std::vector<double> &averages)
  {
    constexpr int most = 12;
    const geometry::CubeLattice &lattice = problem.lattice;
    const auto &n = lattice.n_cells();
    const int step = (*std::max_element(n.begin(), n.end()) + most - 1) / most;
    std::array<int, 3> first{};
    for (unsigned int d = 0; d < 3; ++d)
      first[d] = std::min((step - 1) / 2, n[d] - 1);
    SolutionGrid grid;
    grid.h = problem.h();
    grid.horizon = problem.horizon();
    grid.spacing = step * problem.h();
    grid.n_components = problem.n_components;
    for (unsigned int d = 0; d < 3; ++d)
    {
      grid.lower[d] = lattice.coordinate(d, 0);
      grid.upper[d] = lattice.coordinate(d, n[d]);
      grid.first[d] = lattice.coordinate(d, first[d] + .5);
      grid.n[d] = (n[d] - first[d] + step - 1) / step;
    }
    BlockMeans values(std::size_t{grid.n[0]} * grid.n[1] * grid.n[2]);
    for_each_own_cell(problem, ranks,
                      [&](const std::array<int, 3> &cell, std::size_t place)
                      {
                        std::size_t point = 0;
                        for (const unsigned int d : {2u, 1u, 0u})
                        {
                          const int steps = cell[d] - first[d];
                          if (steps < 0 || steps % step != 0)
                            return;
                          point = point * grid.n[d] + steps / step;
                        }
                        values.add(point, &averages[place], problem.n_components);
                      });
    grid.values = values.means(ranks);
    return grid;
  }
} // namespace plumbline::study
