#include "meshfree/check/nodes_in_space.h"

#include "base/error.h"
#include "geometry/node_cells_in_space.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumbline::meshfree
{
  namespace
  {
    bool is_inside(const geometry::Cuboid &omega, const Point<3> &x)
    {
      for (unsigned int d = 0; d < 3; ++d)
        if (!(x[d] > omega.lower[d] && x[d] < omega.upper[d]))
          return false;
      return true;
    }

    std::size_t n_free(const GivenNodes<3> &nodes, const geometry::Cuboid &omega)
    {
      const auto n = nodes.box ? nodes.size() - nodes.n_images
                               : static_cast<std::size_t>(std::count_if(
                                     nodes.places.begin(), nodes.places.end(),
                                     [&](const Point<3> &x) { return is_inside(omega, x); }));
      if (n == 0)
        throw InputError("'" + nodes.file + "': none of the " + std::to_string(nodes.size()) +
                         " nodes lies in the domain; check the units, and give as domain the box "
                         "of the free nodes");
      return n;
    }

    bool are_on_lattice(const GivenNodes<3> &nodes, double h)
    {
      constexpr double off = 1e-4; // of h
      for (const Point<3> &x : nodes.places)
        for (unsigned int d = 0; d < 3; ++d)
        {
          const double s = (x[d] - nodes.places.front()[d]) / h;
          if (std::abs(s - std::round(s)) > off)
            return false;
        }
      return true;
    }

    /// Free nodes first, each with the volume of a cube.
    geometry::NodeCells<3> cubes(const GivenNodes<3> &nodes, const geometry::Cuboid &omega,
                                 double h)
    {
      geometry::NodeCells<3> cells;
      cells.source.resize(nodes.size());
      std::iota(cells.source.begin(), cells.source.end(), 0);
      cells.n_free = n_free(nodes, omega);
      if (!nodes.box)
        std::stable_partition(cells.source.begin(), cells.source.end(),
                              [&](std::size_t k) { return is_inside(omega, nodes.places[k]); });
      for (const std::size_t k : cells.source)
        cells.nodes.push_back(nodes.places[k]);
      cells.centroid = cells.nodes;
      cells.area.assign(nodes.size(), h * h * h);
      cells.first_piece.assign(nodes.size() + 1, 0);
      return cells;
    }

    /// Near the spacing, and a whole fraction of all sides of Ω where there is such a length.
    double cube_side(const geometry::Cuboid &omega, double spacing)
    {
      constexpr double most = 3, whole = 1e-9;
      const auto side = [&](unsigned int d) { return omega.upper[d] - omega.lower[d]; };
      double best = spacing;
      double off = std::log(most);
      for (int n = 1; side(0) / n > spacing / most; ++n)
      {
        const double h = side(0) / n;
        bool divides = true;
        for (unsigned int d = 1; d < 3; ++d)
          divides =
              divides && std::abs(side(d) / h - std::round(side(d) / h)) < whole * side(d) / h;
        if (divides && std::abs(std::log(h / spacing)) < off)
        {
          off = std::abs(std::log(h / spacing));
          best = h;
        }
      }
      return best;
    }

    /// The same nodes, in an order of their own, with Voronoi cells; those too far away for a cell
    /// have none.
    geometry::NodeCells<3> voronoi(const GivenNodes<3> &nodes, const geometry::Cuboid &omega,
                                   double h, double horizon)
    {
      const geometry::CubeLattice lattice({{omega}, {}}, cube_side(omega, h));
      geometry::NodeCells<3> cells = geometry::voronoi_cells(nodes.places, lattice, horizon);
      std::vector<std::size_t> order(cells.size());
      std::iota(order.begin(), order.end(), 0);
      const auto is_free = [&](std::size_t c)
      {
        const std::size_t k = cells.source[c];
        return nodes.box ? k < nodes.size() - nodes.n_images : is_inside(omega, nodes.places[k]);
      };
      std::stable_partition(order.begin(), order.end(), is_free);
      cells = reordered(cells, order, n_free(nodes, omega));
      std::vector<bool> has_cell(nodes.size());
      for (const std::size_t k : cells.source)
        has_cell[k] = true;
      for (std::size_t k = 0; k < nodes.size(); ++k)
        if (!has_cell[k])
        {
          cells.nodes.push_back(nodes.places[k]);
          cells.source.push_back(k);
          cells.centroid.push_back(nodes.places[k]);
          cells.area.push_back(h * h * h);
          cells.first_piece.push_back(cells.pieces.size());
        }
      return cells;
    }
  } // namespace

  double node_spacing(const GivenNodes<3> &nodes, const geometry::Cuboid &omega)
  {
    double volume = 1;
    for (unsigned int d = 0; d < 3; ++d)
      volume *= omega.upper[d] - omega.lower[d];
    return std::cbrt(volume / static_cast<double>(n_free(nodes, omega)));
  }

  CellsInSpace given_cells(const GivenNodes<3> &nodes, const geometry::Cuboid &omega,
                           double horizon)
  {
    const double h = node_spacing(nodes, omega);
    CellsInSpace result;
    if (are_on_lattice(nodes, h))
    {
      result.cells = cubes(nodes, omega, h);
      result.lattice = h;
      return result;
    }
    try
    {
      result.cells = voronoi(nodes, omega, h, horizon);
    }
    catch (const InputError &)
    { // they do not fill the interaction domain: no rule can be compared with them
      result.cells = cubes(nodes, omega, h);
    }
    return result;
  }
} // namespace plumbline::meshfree
