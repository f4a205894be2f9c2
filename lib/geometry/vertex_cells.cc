#include "geometry/vertex_cells.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

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

    /// Below this fraction of h an overlap of boxes, and of h² a cell, is rounding.
    constexpr double rounding = 1e-9;

    /// Nodes with the pieces of their cells, the free ones first.
    NodeCells<2> free_first(const std::vector<Point<2>> &nodes,
                            const std::vector<std::size_t> &source,
                            const std::function<bool(std::size_t)> &is_free,
                            const std::function<std::vector<Polygon>(std::size_t)> &pieces)
    {
      NodeCells<2> cells;
      std::vector<std::size_t> order(nodes.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
      cells.n_free = static_cast<std::size_t>(
          std::stable_partition(order.begin(), order.end(), is_free) - order.begin());
      cells.first_piece = {0};
      for (const std::size_t c : order)
      {
        cells.source.push_back(source.empty() ? c : source[c]);
        cells.nodes.push_back(nodes[c]);
        double whole = 0;
        Point<2> middle;
        for (Polygon &piece : pieces(c))
        {
          const double part = area(view(piece));
          whole += part;
          middle += part * centroid(view(piece));
          cells.pieces.push_back(std::move(piece));
        }
        cells.area.push_back(whole);
        cells.centroid.push_back(middle / whole);
        cells.first_piece.push_back(cells.pieces.size());
      }
      return cells;
    }

    Polygon corners(const Box &box)
    {
      return {box.lower, {box.upper[0], box.lower[1]}, box.upper, {box.lower[0], box.upper[1]}};
    }

    Polygon square_about(const Point<2> &node, double h)
    {
      const Point<2> half(h / 2, h / 2);
      return corners({Point<2>(node - half), node + half});
    }

    /// The fixed boxes, and which of them hold something.
    class FixedBoxes
    {
    public:
      FixedBoxes(const std::vector<Box> &boxes, double h)
          : boxes_(boxes), h_(h), is_used_(boxes.size())
      {
      }

      /// Whether a convex cell shares area with one of them.
      bool hold(const Polygon &cell)
      {
        const Box around = bounding_box(view(cell));
        bool is_constrained = false;
        for (std::size_t b = 0; b < boxes_.size(); ++b)
        {
          const Box &box = boxes_[b];
          bool is_near = true;
          for (unsigned int d = 0; d < 2; ++d)
            is_near = is_near && std::min(around.upper[d], box.upper[d]) -
                                         std::max(around.lower[d], box.lower[d]) >
                                     rounding * h_;
          if (!is_near ||
              area(view(overlap(view(cell), view(corners(box))))) <= rounding * rounding * h_ * h_)
            continue;
          is_used_[b] = is_constrained = true;
        }
        return is_constrained;
      }

      /// @throws InputError  boxes that hold all or nothing, or a box that holds nothing
      void check(const NodeCells<2> &cells) const
      {
        if (cells.n_free == 0)
          throw InputError(
              "the fixed part covers all of the body; give a smaller one (Domain/fixed)");
        if (cells.n_free == cells.size() && !boxes_.empty())
          throw InputError("nothing of the body is fixed, so it can move as a whole (3 rigid modes "
                           "in the plane) and there is no one solution; fix a part (Domain/fixed)");
        for (std::size_t b = 0; b < boxes_.size(); ++b)
          if (!is_used_[b])
          {
            std::ostringstream message;
            message << "the fixed box " << boxes_[b].lower[0] << ", " << boxes_[b].lower[1] << " : "
                    << boxes_[b].upper[0] << ", " << boxes_[b].upper[1]
                    << " lies beside the body; move it in, or take it out (Domain/fixed)";
            throw InputError(message.str());
          }
      }

    private:
      const std::vector<Box> &boxes_;
      double h_;
      std::vector<bool> is_used_;
    };
  } // namespace

  Point<2> NodeLattice::node(std::size_t i) const
  {
    return {origin[0] + h * static_cast<double>(i % n[0]),
            origin[1] + h * static_cast<double>(i / n[0])};
  }

  void for_squares_in(const NodeLattice &lattice, const Polygon &polygon,
                      const std::function<void(std::size_t i, const Polygon &common)> &visit)
  {
    const auto rows = [&](const Box &box, unsigned int d)
    {
      const auto steps = [&](double x) { return (x - lattice.origin[d]) / lattice.h; };
      return std::make_pair(std::max(0, static_cast<int>(steps(box.lower[d]) - .5)),
                            std::min(lattice.n[d] - 1, static_cast<int>(steps(box.upper[d]) + .5)));
    };
    Box strip = bounding_box(view(polygon)); // row by row, so that squares meet few sides
    const auto [first, last] = rows(strip, 1);
    for (int i2 = first; i2 <= last; ++i2)
    {
      strip.lower[1] = lattice.origin[1] + (i2 - .5) * lattice.h;
      strip.upper[1] = lattice.origin[1] + (i2 + .5) * lattice.h;
      const Polygon row = overlap(view(polygon), view(corners(strip)));
      if (row.empty())
        continue;
      const auto [from, to] = rows(bounding_box(view(row)), 0);
      for (int i1 = from; i1 <= to; ++i1)
      {
        const std::size_t i = static_cast<std::size_t>(i2) * lattice.n[0] + i1;
        const Polygon common = overlap(view(square_about(lattice.node(i), lattice.h)), view(row));
        if (!common.empty())
          visit(i, common);
      }
    }
  }

  VertexCells vertex_cells(const Lattice &body, const std::vector<Box> &fixed)
  {
    if (!body.is_rectangle())
      throw InputError("a body with a free boundary on a lattice must be one box without holes; "
                       "write Domain/mesh = squares or triangles for others");
    Mesh mesh;
    const std::array<int, 2> &n = body.n_cells();
    const auto x = breaks(n[0]), y = breaks(n[1]);
    for (const double t : y)
      for (const double s : x)
        mesh.vertices.push_back(body.point(s, t));
    const auto vertex = [&](int i, int j) { return static_cast<unsigned int>(j * x.size() + i); };
    std::vector<Point<2>> nodes;
    FixedBoxes constrained(fixed, body.h());
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i <= n[0]; ++i)
      {
        const Box box{body.point(x[i], y[j]), body.point(x[i + 1], y[j + 1])};
        mesh.cells.push_back(
            {{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)},
             4,
             !constrained.hold(corners(box))});
        nodes.push_back(body.point(i, j));
      }
    NodeCells<2> cells = free_first(
        nodes, {}, [&](std::size_t c) { return mesh.cells[c].is_inside; },
        [&](std::size_t c) { return std::vector<Polygon>{mesh.polygon(c)}; });
    constrained.check(cells);
    return {{body.h(), body.origin(), {n[0] + 1, n[1] + 1}},
            std::make_shared<const NodeCells<2>>(std::move(cells)),
            std::make_shared<const Mesh>(std::move(mesh))};
  }

  VertexCells vertex_cells(std::shared_ptr<const Mesh> mesh, const Point<2> &origin, double h,
                           const std::vector<Box> &fixed)
  {
    constexpr double uncut = 1e-12; // of a square: what a square in the body may lack
    if (!(h > 0))
      throw InputError("lattice size h = " + std::to_string(h) + " must be a positive length");
    const Box around = bounding_box(view(mesh->vertices));
    NodeLattice lattice{h, {}, {}};
    for (unsigned int d = 0; d < 2; ++d)
    {
      const auto steps = [&](double x) { return std::floor((x - origin[d]) / h + .5); };
      lattice.origin[d] = origin[d] + h * steps(around.lower[d]);
      lattice.n[d] = static_cast<int>(steps(around.upper[d]) - steps(around.lower[d])) + 1;
    }
    std::vector<std::vector<Polygon>> parts(lattice.size());
    for (std::size_t c = 0; c < mesh->cells.size(); ++c)
      for_squares_in(lattice, mesh->polygon(c),
                     [&](std::size_t i, const Polygon &common) { parts[i].push_back(common); });

    FixedBoxes constrained(fixed, h);
    std::vector<Point<2>> nodes;
    std::vector<std::size_t> source;
    std::vector<char> is_free;
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      double sum = 0;
      for (const Polygon &part : parts[i])
        sum += area(view(part));
      if (sum <= rounding * h * h)
        continue;
      const Point<2> node = lattice.node(i);
      if (std::abs(sum - h * h) <= uncut * h * h)
        parts[i].assign(1, square_about(node, h));
      nodes.push_back(node);
      source.push_back(i);
      bool is_constrained = false;
      for (const Polygon &part : parts[i])
        is_constrained = constrained.hold(part) || is_constrained;
      is_free.push_back(static_cast<char>(!is_constrained));
    }
    NodeCells<2> cells = free_first(
        nodes, source, [&](std::size_t c) { return is_free[c] != 0; },
        [&](std::size_t c) { return std::move(parts[source[c]]); });
    constrained.check(cells);
    return {lattice, std::make_shared<const NodeCells<2>>(std::move(cells)), std::move(mesh)};
  }

  NodeCells<2> vertex_squares(const Lattice &lattice, double reach)
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
    NodeCells<2> cells = free_first(
        nodes, {}, [&](std::size_t c) { return is_free[c] != 0; },
        [&](std::size_t c) { return std::vector<Polygon>{square_about(nodes[c], h)}; });
    if (cells.n_free == 0)
      throw InputError("no vertex of the lattice lies inside the domain; choose a smaller h "
                       "(Study/h), or Methods/nodes = centres");
    return cells;
  }
} // namespace plumbline::geometry
