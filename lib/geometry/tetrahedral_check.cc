#include "geometry/tetrahedral_check.h"

#include "base/error.h"
#include "base/number_text.h"
#include "geometry/search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <tuple>

namespace plumbline::geometry
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;
    using Triangle = std::array<Point<3>, 3>;

    /// A cell whose sixfold volume is less than this fraction of its longest edge cubed is
    /// degenerate: as many digits of its gradients are lost.
    constexpr double flat = 1e-10;

    /// What is nearer to a face than this fraction of its size is meant to be on it.
    constexpr double near = 1e-6;

    /// Overlaps of two faces below this fraction of the smaller one come from rounded coordinates.
    constexpr double no_overlap = 1e-3;

    [[noreturn]] void reject(const std::string &what, const Point<3> &place,
                             const std::string &remedy)
    {
      std::ostringstream message;
      message << what << " at (" << place[0] << ", " << place[1] << ", " << place[2] << ") "
              << remedy;
      throw InputError(message.str());
    }

    std::string name(std::size_t cell)
    {
      return "cell " + std::to_string(cell);
    }

    template <std::size_t n>
    Point<3> middle(const TetrahedralMesh &mesh, const std::array<unsigned int, n> &vertices)
    {
      Tensor<1, 3> sum;
      for (const unsigned int vertex : vertices)
        sum += mesh.vertices[vertex];
      return Point<3>(sum / static_cast<double>(n));
    }

    template <class Vertices>
    Cuboid box_around(const Vertices &vertices, double margin)
    {
      Cuboid box{vertices[0], vertices[0]};
      for (const Point<3> &x : vertices)
        for (unsigned int d = 0; d < 3; ++d)
        {
          box.lower[d] = std::min(box.lower[d], x[d]);
          box.upper[d] = std::max(box.upper[d], x[d]);
        }
      for (unsigned int d = 0; d < 3; ++d)
      {
        box.lower[d] -= margin;
        box.upper[d] += margin;
      }
      return box;
    }

    std::array<Point<3>, 4> corners(const TetrahedralMesh &mesh, std::size_t cell)
    {
      const auto &v = mesh.cells[cell];
      return {mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]], mesh.vertices[v[3]]};
    }

    Triangle corners(const TetrahedralMesh &mesh, const TetrahedralSide &side)
    {
      const auto &v = side.key;
      return {mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]]};
    }

    template <class Vertices>
    double longest_edge(const Vertices &x)
    {
      double longest = 0;
      for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          longest = std::max(longest, x[i].distance(x[j]));
      return longest;
    }

    double area(const std::vector<Point<3>> &polygon)
    {
      Tensor<1, 3> sum;
      for (std::size_t k = 2; k < polygon.size(); ++k)
        sum += cross_product_3d(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
      return sum.norm() / 2;
    }

    // ---- what is allowed ------------------------------------------------------------------------

    void check_cells(const TetrahedralMesh &mesh)
    {
      for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
        if (!std::isfinite(mesh.vertices[v].square()))
          reject("vertex " + std::to_string(v), mesh.vertices[v],
                 "is not finite; give finite coordinates");
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      {
        const double size = determinant(mesh, cell),
                     least = flat * std::pow(longest_edge(corners(mesh, cell)), 3);
        const Point<3> place = middle(mesh, mesh.cells[cell]);
        if (!(std::abs(size) > least))
          reject(name(cell), place,
                 "is degenerate, its volume is zero; take it out or move its vertices apart");
        if (size < 0)
          reject(name(cell), place, "is inverted; swap two of its vertices");
      }
    }

    [[noreturn]] void reject_overlap(std::size_t a, std::size_t b, const Point<3> &place)
    {
      reject("cells " + std::to_string(std::min(a, b)) + " and " + std::to_string(std::max(a, b)),
             place, "overlap; take one out, or mesh the bodies together");
    }

    /// Of a face with two cells: they must lie on both sides of it.
    void check_pair(const TetrahedralMesh &mesh, const TetrahedralSide &a, const TetrahedralSide &b)
    {
      const Triangle x = corners(mesh, a);
      const Tensor<1, 3> normal = cross_product_3d(x[1] - x[0], x[2] - x[0]);
      const auto height = [&](const TetrahedralSide &side)
      { return normal * (mesh.vertices[mesh.cells[side.cell][side.opposite]] - x[0]); };
      if (height(a) * height(b) > 0)
        reject_overlap(a.cell, b.cell, middle(mesh, a.key));
    }

    /// The faces of one cell alone.
    std::vector<TetrahedralSide> single_sides(const TetrahedralMesh &mesh)
    {
      const std::vector<TetrahedralSide> sides = sides_of(mesh);
      std::vector<TetrahedralSide> single;
      for (std::size_t first = 0, last = 0; first < sides.size(); first = last)
      {
        while (last < sides.size() && sides[last].key == sides[first].key)
          ++last;
        if (last - first > 2)
          reject("a face of " + name(sides[first].cell) + ", " + name(sides[first + 1].cell) +
                     " and " + name(sides[first + 2].cell),
                 middle(mesh, sides[first].key),
                 "belongs to more than two cells; take out cells that are given twice or overlap");
        if (last - first == 2)
          check_pair(mesh, sides[first], sides[first + 1]);
        else
          single.push_back(sides[first]);
      }
      return single;
    }

    /// How far x is inside a cell, from its nearest face; negative outside.
    double depth(const TetrahedralMesh &mesh, std::size_t cell, const Point<3> &x)
    {
      const auto c = corners(mesh, cell);
      double least = std::numeric_limits<double>::infinity();
      for (unsigned int k = 0; k < 4; ++k)
      {
        const Point<3> &a = c[(k + 1) % 4];
        Tensor<1, 3> normal = cross_product_3d(c[(k + 2) % 4] - a, c[(k + 3) % 4] - a);
        normal *= (normal * (c[k] - a) > 0 ? 1 : -1) / normal.norm();
        least = std::min(least, normal * (x - a));
      }
      return least;
    }

    /// The part of a triangle that is in a cell, or within a margin of it.
    std::vector<Point<3>> common_part(const TetrahedralMesh &mesh, const Triangle &triangle,
                                      std::size_t cell, double margin)
    {
      std::vector<Point<3>> part(triangle.begin(), triangle.end());
      const auto c = corners(mesh, cell);
      for (unsigned int k = 0; k < 4 && !part.empty(); ++k)
      {
        const Point<3> &a = c[(k + 1) % 4];
        Tensor<1, 3> normal = cross_product_3d(c[(k + 2) % 4] - a, c[(k + 3) % 4] - a);
        normal *= (normal * (c[k] - a) > 0 ? 1 : -1) / normal.norm();
        std::vector<Point<3>> kept;
        for (std::size_t i = 0; i < part.size(); ++i)
        {
          const Point<3> &x = part[i], &y = part[(i + 1) % part.size()];
          const double s = normal * (x - a) + margin, t = normal * (y - a) + margin;
          if (s >= 0)
            kept.push_back(x);
          if ((s >= 0) != (t >= 0))
            kept.push_back(x + s / (s - t) * (y - x));
        }
        part = std::move(kept);
      }
      return part;
    }

    /// Two cells that share a place but no face there.
    [[noreturn]] void reject_misfit(const TetrahedralMesh &mesh, const TetrahedralSide &side,
                                    std::size_t other, const Point<3> &place, double reach)
    {
      if (depth(mesh, other, place) > 2 * reach)
        reject_overlap(side.cell, other, place);
      for (const unsigned int a : side.key)
        for (const unsigned int b : mesh.cells[other])
          if (a != b && mesh.vertices[a].distance(mesh.vertices[b]) <= reach)
            reject("vertex " + std::to_string(b) + " of " + name(other), mesh.vertices[b],
                   "lies where " + name(side.cell) +
                       " has another vertex; let the cells share one (gmsh: Coherence Mesh)");
      reject("a face of " + name(side.cell), middle(mesh, side.key),
             "is partly covered by another one, of " + name(other) +
                 ", so that the mesh is not conforming; let cells share whole faces (gmsh: "
                 "Coherence or BooleanFragments before meshing)");
    }

    /// Wherever cells overlap or do not fit together, a face of one cell alone lies in or on
    /// another cell: the number of cells that cover a place changes at such faces only.
    void check_single_sides(const TetrahedralMesh &mesh, const std::vector<TetrahedralSide> &single)
    {
      std::vector<Cuboid> boxes;
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
        boxes.push_back(box_around(corners(mesh, cell), 0));
      const BoxSearch<3> search(std::move(boxes));
      std::vector<unsigned int> found;
      for (const TetrahedralSide &side : single)
      {
        const Triangle triangle = corners(mesh, side);
        const double reach = near * longest_edge(triangle),
                     size = area({triangle.begin(), triangle.end()});
        search.find(box_around(triangle, reach), found);
        for (const unsigned int other : found)
        {
          if (other == side.cell)
            continue;
          const double least =
              no_overlap * std::min(size, std::pow(std::abs(determinant(mesh, other)), 2. / 3));
          const std::vector<Point<3>> part = common_part(mesh, triangle, other, reach);
          if (part.size() < 3 || area(part) <= least)
            continue;
          Tensor<1, 3> sum;
          for (const Point<3> &x : part)
            sum += x;
          reject_misfit(mesh, side, other, Point<3>(sum / static_cast<double>(part.size())), reach);
        }
      }
    }

    // ---- distances ------------------------------------------------------------------------------

    double distance(const Point<3> &x, const Point<3> &a, const Point<3> &b)
    {
      const Tensor<1, 3> along = b - a;
      return x.distance(a + std::clamp((x - a) * along / along.norm_square(), 0., 1.) * along);
    }

    double distance(const Point<3> &x, const Triangle &triangle)
    {
      const Tensor<1, 3> u = triangle[1] - triangle[0], v = triangle[2] - triangle[0],
                         w = x - triangle[0], normal = cross_product_3d(u, v);
      const double s = cross_product_3d(w, v) * normal, t = cross_product_3d(u, w) * normal;
      if (s >= 0 && t >= 0 && s + t <= normal.norm_square())
        return std::abs(w * normal) / normal.norm();
      return std::min({distance(x, triangle[0], triangle[1]), distance(x, triangle[1], triangle[2]),
                       distance(x, triangle[2], triangle[0])});
    }

    /// Of two segments: between inner points where both lines are nearest there, or from an end.
    double distance(const Point<3> &a, const Point<3> &b, const Point<3> &c, const Point<3> &d)
    {
      const Tensor<1, 3> u = b - a, v = d - c, w = a - c;
      const double uu = u * u, uv = u * v, vv = v * v, uw = u * w, vw = v * w,
                   determinant = uu * vv - uv * uv;
      double least =
          std::min({distance(a, c, d), distance(b, c, d), distance(c, a, b), distance(d, a, b)});
      if (determinant > 0)
      {
        const double s = (uv * vw - vv * uw) / determinant, t = (uu * vw - uv * uw) / determinant;
        if (s > 0 && s < 1 && t > 0 && t < 1)
          least = std::min(least, (w + s * u - t * v).norm());
      }
      return least;
    }

    /// Of two triangles that do not cut each other.
    double distance(const Triangle &a, const Triangle &b)
    {
      double least = std::numeric_limits<double>::infinity();
      for (unsigned int i = 0; i < 3; ++i)
      {
        least = std::min({least, distance(a[i], b), distance(b[i], a)});
        for (unsigned int j = 0; j < 3; ++j)
          least = std::min(least, distance(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]));
      }
      return least;
    }
  } // namespace

  std::vector<TetrahedralSide> sides_of(const TetrahedralMesh &mesh)
  {
    std::vector<TetrahedralSide> sides;
    sides.reserve(4 * mesh.cells.size());
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      for (unsigned int opposite = 0; opposite < 4; ++opposite)
      {
        TetrahedralSide side{{}, cell, opposite};
        for (unsigned int corner = 0, k = 0; corner < 4; ++corner)
          if (corner != opposite)
            side.key[k++] = mesh.cells[cell][corner];
        std::sort(side.key.begin(), side.key.end());
        sides.push_back(side);
      }
    std::sort(sides.begin(), sides.end(),
              [](const TetrahedralSide &a, const TetrahedralSide &b)
              { return std::tie(a.key, a.cell) < std::tie(b.key, b.cell); });
    return sides;
  }

  void check(const TetrahedralMesh &mesh)
  {
    if (std::count(mesh.is_inside.begin(), mesh.is_inside.end(), 1) == 0)
      throw InputError("the mesh has no cells in the domain; give some");
    check_cells(mesh);
    check_single_sides(mesh, single_sides(mesh));
  }

  double collar_width(const TetrahedralMesh &mesh, double up_to)
  {
    const std::vector<TetrahedralSide> sides = sides_of(mesh);
    std::vector<Triangle> of_omega, outer;
    for (std::size_t k = 0; k < sides.size(); ++k)
    {
      const bool is_inside = mesh.is_inside[sides[k].cell] != 0;
      if (k + 1 < sides.size() && sides[k + 1].key == sides[k].key)
      {
        if (is_inside != (mesh.is_inside[sides[k + 1].cell] != 0))
          of_omega.push_back(corners(mesh, sides[k]));
        ++k;
        continue;
      }
      if (is_inside)
        return 0;
      outer.push_back(corners(mesh, sides[k]));
    }
    std::vector<Cuboid> boxes;
    for (const Triangle &triangle : outer)
      boxes.push_back(box_around(triangle, 0));
    const BoxSearch<3> search(std::move(boxes));
    double width = up_to;
    std::vector<unsigned int> found;
    for (const Triangle &triangle : of_omega)
    {
      search.find(box_around(triangle, width), found);
      for (const unsigned int other : found)
        width = std::min(width, distance(triangle, outer[other]));
    }
    return width;
  }

  void check_collar(const TetrahedralMesh &mesh, double reach)
  {
    constexpr double rounding = 1e-9;
    if (const double width = collar_width(mesh, reach); width < reach * (1 - rounding))
      throw InputError(
          "the interaction domain is " + base::to_text(width, 6) +
          " wide at its thinnest place, thinner than the reach of the kernel, " +
          base::to_text(reach, 6) +
          " (the horizon, or twice the horizon with a dilatation), so that balls would "
          "contain points without data; widen the physical "
          "volumes collar... in the mesh, or choose a smaller horizon");
  }
} // namespace plumbline::geometry
