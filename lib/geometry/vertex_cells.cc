#include "geometry/vertex_cells.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace plumbline::geometry
{
  namespace
  {
    /// Where the cells of n + 1 vertices along an axis begin and end, in cells.
    std::vector<double> breaks(int n)
    {
      std::vector<double> result = {0};
      for (int i = 0; i < n; ++i)
        result.push_back(i + .5);
      result.push_back(n);
      return result;
    }

    bool share_area(const Box &a, const Box &b, double least)
    {
      for (unsigned int d = 0; d < 2; ++d)
        if (std::min(a.upper[d], b.upper[d]) - std::max(a.lower[d], b.lower[d]) <= least)
          return false;
      return true;
    }

    /// Nodes with one convex cell each, the free ones first.
    NodeCells free_first(const std::vector<Point<2>> &nodes,
                         const std::function<bool(std::size_t)> &is_free,
                         const std::function<Polygon(std::size_t)> &cell)
    {
      NodeCells cells;
      cells.source.resize(nodes.size());
      std::iota(cells.source.begin(), cells.source.end(), std::size_t{0});
      cells.n_free = static_cast<std::size_t>(
          std::stable_partition(cells.source.begin(), cells.source.end(), is_free) -
          cells.source.begin());
      cells.first_piece = {0};
      for (const std::size_t c : cells.source)
      {
        cells.nodes.push_back(nodes[c]);
        cells.pieces.push_back(cell(c));
        cells.area.push_back(area(view(cells.pieces.back())));
        cells.centroid.push_back(centroid(view(cells.pieces.back())));
        cells.first_piece.push_back(cells.pieces.size());
      }
      return cells;
    }
  } // namespace

  VertexCells vertex_cells(const Lattice &body, const std::vector<Box> &fixed)
  {
    constexpr double rounding = 1e-9; // of h: a box is a multiple of h to that
    if (!body.is_rectangle())
      throw InputError("a body with a free boundary on a lattice must be one box without holes; "
                       "give one box (Domain/boxes), or a mesh (Domain/mesh)");
    Mesh mesh;
    const std::array<int, 2> &n = body.n_cells();
    const auto x = breaks(n[0]), y = breaks(n[1]);
    for (const double t : y)
      for (const double s : x)
        mesh.vertices.push_back(body.point(s, t));
    const auto vertex = [&](int i, int j) { return static_cast<unsigned int>(j * x.size() + i); };
    std::vector<Point<2>> nodes;
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i <= n[0]; ++i)
      {
        const Box box{body.point(x[i], y[j]), body.point(x[i + 1], y[j + 1])};
        const bool is_free =
            std::none_of(fixed.begin(), fixed.end(),
                         [&](const Box &one) { return share_area(box, one, rounding * body.h()); });
        mesh.cells.push_back(
            {{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)}, 4, is_free});
        nodes.push_back(body.point(i, j));
      }
    NodeCells cells = free_first(
        nodes, [&](std::size_t c) { return mesh.cells[c].is_inside; },
        [&](std::size_t c) { return mesh.polygon(c); });
    if (cells.n_free == 0)
      throw InputError("the fixed part covers all of the body; give a smaller one (Domain/fixed)");
    if (cells.n_free == cells.size())
      throw InputError("nothing of the body is fixed, so it can move as a whole (3 rigid modes in "
                       "the plane) and there is no one solution; fix a part (Domain/fixed)");
    return {std::make_shared<const Mesh>(std::move(mesh)),
            std::make_shared<const NodeCells>(std::move(cells))};
  }

  NodeCells vertex_squares(const Lattice &lattice, double reach)
  {
    const double h = lattice.h();
    const int margin = static_cast<int>(std::ceil(reach / h - 1e-9)) + 1;
    std::vector<Point<2>> nodes;
    std::vector<char> is_free;
    for (int j = -margin; j <= lattice.n_cells()[1] + margin; ++j)
      for (int i = -margin; i <= lattice.n_cells()[0] + margin; ++i)
      {
        nodes.push_back(lattice.point(i, j));
        is_free.push_back(
            static_cast<char>(lattice.is_inside(i - 1, j - 1) && lattice.is_inside(i, j - 1) &&
                              lattice.is_inside(i - 1, j) && lattice.is_inside(i, j)));
      }
    NodeCells cells = free_first(
        nodes, [&](std::size_t c) { return is_free[c] != 0; },
        [&](std::size_t c)
        {
          const Point<2> &x = nodes[c];
          return Polygon{{x[0] - h / 2, x[1] - h / 2},
                         {x[0] + h / 2, x[1] - h / 2},
                         {x[0] + h / 2, x[1] + h / 2},
                         {x[0] - h / 2, x[1] + h / 2}};
        });
    if (cells.n_free == 0)
      throw InputError("no vertex of the lattice lies inside the domain; choose a smaller h "
                       "(Study/h), or Methods/nodes = centres");
    return cells;
  }
} // namespace plumbline::geometry
