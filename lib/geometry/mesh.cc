#include "geometry/mesh.h"

#include "base/error.h"
#include "geometry/search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace plumbline::geometry
{
  namespace
  {
    using dealii::Tensor;

    /// A cell thinner than this, its area over its longest side squared, is degenerate: the digits
    /// that are lost in proportion would be most of them.
    constexpr double flat = 1e-10;

    /// A vertex nearer to a side than this fraction of the side's length is meant to be on it.
    constexpr double near = 1e-6;

    /// Overlaps below this fraction of the smaller cell's area come from rounded coordinates.
    constexpr double no_overlap = 1e-9;

    [[noreturn]] void reject(const std::string &what, const Point<2> &place,
                             const std::string &remedy)
    {
      std::ostringstream message;
      message << what << " at (" << place[0] << ", " << place[1] << ") " << remedy;
      throw InputError(message.str());
    }

    std::string name(std::size_t cell)
    {
      return "cell " + std::to_string(cell);
    }

    Point<2> middle(const Polygon &cell)
    {
      Tensor<1, 2> sum;
      for (const auto &vertex : cell)
        sum += vertex;
      return Point<2>(sum / static_cast<double>(cell.size()));
    }

    /// A side as one of its cells sees it: counter-clockwise.
    struct Side
    {
      unsigned int from, to;
      std::size_t cell;
      unsigned int index; ///< from the cell's vertex of that index to the next

      std::pair<unsigned int, unsigned int> key() const { return std::minmax(from, to); }
    };

    /// Calls f with each side, as its cells see it.
    template <class F>
    void for_each_side(const Mesh &mesh, const F &f)
    {
      std::vector<Side> sides;
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        const MeshCell &cell = mesh.cells[c];
        for (unsigned int i = 0; i < cell.n_vertices; ++i)
          sides.push_back({cell.vertex[i], cell.vertex[(i + 1) % cell.n_vertices], c, i});
      }
      std::sort(sides.begin(), sides.end(),
                [](const Side &a, const Side &b)
                { return std::make_pair(a.key(), a.cell) < std::make_pair(b.key(), b.cell); });
      for (std::size_t first = 0, last = 0; first < sides.size(); first = last)
      {
        while (last < sides.size() && sides[last].key() == sides[first].key())
          ++last;
        f(ArrayView<const Side>(&sides[first], last - first));
      }
    }

    double distance(const Point<2> &point, const Point<2> &a, const Point<2> &b)
    {
      const Tensor<1, 2> along = b - a;
      const double s = std::clamp((point - a) * along / along.norm_square(), 0., 1.);
      return point.distance(a + s * along);
    }

    // ---- what is allowed ------------------------------------------------------------------------

    void check_vertices(const Mesh &mesh)
    {
      for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
        if (!std::isfinite(mesh.vertices[v][0]) || !std::isfinite(mesh.vertices[v][1]))
          reject("vertex " + std::to_string(v), mesh.vertices[v],
                 "is not finite; give finite coordinates");
    }

    void check_shape(const Polygon &cell, std::size_t number)
    {
      double longest = 0;
      for (std::size_t i = 0; i < cell.size(); ++i)
        longest = std::max(longest, cell[i].distance(cell[(i + 1) % cell.size()]));
      const double least = flat * longest * longest;
      if (std::abs(area(cell)) <= least)
        reject(name(number), middle(cell),
               "is degenerate, its area is zero; take it out or move its vertices apart");
      std::size_t n_left = 0, n_right = 0; // turns
      for (std::size_t i = 0; i < cell.size(); ++i)
      {
        const std::array<Point<2>, 3> corner{cell[i], cell[(i + 1) % cell.size()],
                                             cell[(i + 2) % cell.size()]};
        const double turn = area({corner.data(), 3});
        n_left += turn > least;
        n_right += turn < -least;
      }
      if (n_right == cell.size())
        reject(name(number), middle(cell), "is inverted; number its vertices counter-clockwise");
      if (n_left < cell.size())
        reject(name(number), middle(cell),
               "is not convex; move its vertices until all angles are below 180 degrees, or cut it "
               "into triangles");
    }

    /// Wherever cells do not fit together, the sides in question belong to one cell each.
    void check_sides(const Mesh &mesh)
    {
      std::vector<Side> single;
      const auto collect = [&](ArrayView<const Side> views)
      {
        if (views.size() > 2)
          reject("a side of " + name(views[0].cell) + ", " + name(views[1].cell) + " and " +
                     name(views[2].cell),
                 mesh.vertices[views[0].from],
                 "belongs to more than two cells; take out cells that are given twice or overlap");
        if (views.size() == 1)
          single.push_back(views[0]);
      };
      for_each_side(mesh, collect);

      const auto segment = [&](const Side &side) {
        return Polygon{mesh.vertices[side.from], mesh.vertices[side.to]};
      };
      std::vector<Box> boxes;
      for (const Side &side : single)
        boxes.push_back(bounding_box(view(segment(side))));
      const BoxSearch<2> search(boxes);
      std::vector<unsigned int> found;
      for (const Side &side : single)
      {
        const Polygon ends = segment(side);
        const double reach = near * ends[0].distance(ends[1]);
        Box box = bounding_box(view(ends));
        for (unsigned int d = 0; d < 2; ++d)
          box.lower[d] -= reach, box.upper[d] += reach;
        search.find(box, found);
        for (const unsigned int f : found)
          for (const unsigned int v : {single[f].from, single[f].to})
          {
            const Point<2> &vertex = mesh.vertices[v];
            if (v == side.from || v == side.to || distance(vertex, ends[0], ends[1]) > reach)
              continue;
            const bool at_end =
                std::min(vertex.distance(ends[0]), vertex.distance(ends[1])) <= reach;
            reject("vertex " + std::to_string(v) + " of " + name(single[f].cell), vertex,
                   at_end ? "lies where " + name(side.cell) +
                                " has another vertex; let the cells share one"
                          : "lies inside a side of " + name(side.cell) +
                                " (a hanging vertex); make the mesh conforming");
          }
      }
    }

    void check_overlaps(const Mesh &mesh)
    {
      std::vector<Polygon> cells;
      std::vector<Box> boxes;
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        cells.push_back(mesh.polygon(c));
        boxes.push_back(bounding_box(view(cells[c])));
      }
      const BoxSearch<2> search(boxes);
      std::vector<unsigned int> found;
      for (std::size_t c = 0; c < cells.size(); ++c)
      {
        search.find(boxes[c], found);
        for (const unsigned int other : found)
        {
          if (other >= c)
            break; // ascending: the rest comes later as c
          const Polygon common = overlap(cells[c], cells[other]);
          if (area(common) > no_overlap * std::min(area(cells[c]), area(cells[other])))
            reject("cells " + std::to_string(other) + " and " + std::to_string(c), middle(common),
                   "overlap; take one out or move their vertices");
        }
      }
    }
  } // namespace

  Polygon Mesh::polygon(std::size_t cell) const
  {
    Polygon result;
    result.reserve(cells[cell].n_vertices);
    for (unsigned int i = 0; i < cells[cell].n_vertices; ++i)
      result.push_back(vertices[cells[cell].vertex[i]]);
    return result;
  }

  bool Mesh::is_triangles() const
  {
    return std::all_of(cells.begin(), cells.end(),
                       [](const MeshCell &cell) { return cell.n_vertices == 3; });
  }

  bool Mesh::is_quads() const
  {
    return std::all_of(cells.begin(), cells.end(),
                       [](const MeshCell &cell) { return cell.n_vertices == 4; });
  }

  double Mesh::longest_side() const
  {
    double longest = 0;
    for (const MeshCell &cell : cells)
      for (unsigned int i = 0; cell.is_inside && i < cell.n_vertices; ++i)
        longest = std::max(longest, vertices[cell.vertex[i]].distance(
                                        vertices[cell.vertex[(i + 1) % cell.n_vertices]]));
    return longest;
  }

  Box bounding_box(const Mesh &mesh)
  {
    Polygon inside;
    for (const MeshCell &cell : mesh.cells)
      for (unsigned int i = 0; cell.is_inside && i < cell.n_vertices; ++i)
        inside.push_back(mesh.vertices[cell.vertex[i]]);
    return bounding_box(view(inside));
  }

  void check(const Mesh &mesh)
  {
    if (std::none_of(mesh.cells.begin(), mesh.cells.end(),
                     [](const MeshCell &cell) { return cell.is_inside; }))
      throw InputError(
          "none of the " + std::to_string(mesh.cells.size()) +
          " cells of the mesh lies in the domain; mark those of the domain (by Domain/inside, "
          "or a physical surface 'omega')");
    check_vertices(mesh);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      check_shape(mesh.polygon(c), c);
    check_sides(mesh);
    check_overlaps(mesh);
  }

  double collar_width(const Mesh &mesh)
  {
    std::vector<Side> inner, outer;
    const auto collect = [&](ArrayView<const Side> views)
    {
      std::size_t n_inside = 0;
      for (const Side &side : views)
        n_inside += mesh.cells[side.cell].is_inside;
      if (n_inside == 1)
        inner.push_back(mesh.cells[views[0].cell].is_inside ? views[0] : views[1]);
      if (views.size() == 1)
        outer.push_back(views[0]);
    };
    for_each_side(mesh, collect);

    // the boundaries do not cross, so that a vertex of one of them is nearest; both are closed and
    // run one way around, so that every vertex is the first of a side
    double least = std::numeric_limits<double>::max();
    const auto &v = mesh.vertices;
    for (const Side &a : inner)
      for (const Side &b : outer)
        least = std::min({least, distance(v[a.from], v[b.from], v[b.to]),
                          distance(v[b.from], v[a.from], v[a.to])});
    return least;
  }

  Mesh refine(const Mesh &mesh)
  {
    Mesh fine;
    fine.vertices = mesh.vertices;
    fine.groups = mesh.groups;
    const auto add_vertex = [&](const Point<2> &point)
    {
      fine.vertices.push_back(point);
      return static_cast<unsigned int>(fine.vertices.size() - 1);
    };
    std::vector<std::array<unsigned int, 4>> middles(mesh.cells.size());
    const auto halve = [&](ArrayView<const Side> views)
    {
      const Point<2> &a = mesh.vertices[views[0].from], &b = mesh.vertices[views[0].to];
      const unsigned int number = add_vertex(a + .5 * (b - a));
      for (const Side &side : views)
        middles[side.cell][side.index] = number;
    };
    for_each_side(mesh, halve);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    {
      const MeshCell &cell = mesh.cells[c];
      const unsigned int n = cell.n_vertices;
      const auto &m = middles[c];
      const unsigned int centre = n == 4 ? add_vertex(middle(mesh.polygon(c))) : 0;
      for (unsigned int i = 0; i < n; ++i) // the corners' cells
      {
        const std::array<unsigned int, 4> corner = {
            cell.vertex[i], m[i], n == 4 ? centre : m[(i + 2) % 3], m[(i + n - 1) % n]};
        MeshCell child{corner, n, cell.is_inside, cell.group};
        for (unsigned int k = 0; k < n && n == 4;
             ++k) // quadrilaterals begin where their parent does
          child.vertex[k] = corner[(k + n - i) % n];
        fine.cells.push_back(child);
      }
      if (n == 3)
        fine.cells.push_back({{m[0], m[1], m[2], 0}, 3, cell.is_inside, cell.group});
    }
    return fine;
  }

  Mesh straightened(const Mesh &mesh)
  {
    if (mesh.wholes.empty())
      return mesh;
    Mesh result;
    result.groups = mesh.groups;
    constexpr auto unused = static_cast<unsigned int>(-1);
    std::vector<unsigned int> number(mesh.vertices.size(), unused);
    for (const WholeCell &whole : mesh.wholes)
    {
      MeshCell cell = whole.corners;
      for (unsigned int k = 0; k < cell.n_vertices; ++k)
      {
        unsigned int &place = number[cell.vertex[k]];
        if (place == unused)
        {
          place = static_cast<unsigned int>(result.vertices.size());
          result.vertices.push_back(mesh.vertices[cell.vertex[k]]);
        }
        cell.vertex[k] = place;
      }
      result.cells.push_back(cell);
    }
    return result;
  }
} // namespace plumbline::geometry
