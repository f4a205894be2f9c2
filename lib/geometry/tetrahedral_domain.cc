#include "geometry/tetrahedral_domain.h"

#include "base/error.h"
#include "base/number_text.h"
#include "geometry/hexahedron.h"
#include "geometry/tetrahedral_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace plumbline::geometry
{
  namespace
  {
    using Place = dealii::Point<3>;

    /// Of a cell or a cube: places this near to a face are on it.
    constexpr double rounding = 1e-9;

    void extend(Cuboid &box, const Place &x)
    {
      for (unsigned int d = 0; d < 3; ++d)
      {
        box.lower[d] = std::min(box.lower[d], x[d]);
        box.upper[d] = std::max(box.upper[d], x[d]);
      }
    }

    /// The least of the four linear functions of a cell's corners at x: >= 0 in it.
    double least_coordinate(const TetrahedralMesh &mesh, std::size_t cell, const Place &x)
    {
      const auto &v = mesh.cells[cell];
      const double whole = determinant(mesh, cell);
      double least = 1;
      for (unsigned int k = 0; k < 4; ++k)
      {
        std::array<Place, 4> y;
        for (unsigned int i = 0; i < 4; ++i)
          y[i] = i == k ? x : mesh.vertices[v[i]];
        least = std::min(least, (y[1] - y[0]) * cross_product_3d(y[2] - y[0], y[3] - y[0]) / whole);
      }
      return least;
    }

    /// Whether a triangle meets the inside of a box.
    bool cuts(std::vector<Place> triangle, const Cuboid &box)
    {
      for (unsigned int d = 0; d < 3; ++d)
        for (const bool is_upper : {false, true})
        {
          const auto depth = [&](const Place &x)
          { return is_upper ? box.upper[d] - x[d] : x[d] - box.lower[d]; };
          std::vector<Place> kept;
          for (std::size_t i = 0; i < triangle.size(); ++i)
          {
            const Place &x = triangle[i], &y = triangle[(i + 1) % triangle.size()];
            const double s = depth(x), t = depth(y);
            if (s > 0)
              kept.push_back(x);
            if ((s > 0) != (t > 0))
              kept.push_back(x + s / (s - t) * (y - x));
          }
          triangle = std::move(kept);
        }
      return !triangle.empty();
    }

    /// The faces of Ω's boundary.
    std::vector<std::vector<Place>> boundary(const TetrahedralMesh &mesh)
    {
      const std::vector<TetrahedralSide> sides = sides_of(mesh);
      std::vector<std::vector<Place>> triangles;
      for (std::size_t k = 0; k < sides.size(); ++k)
      {
        const bool is_inside = mesh.is_inside[sides[k].cell] != 0,
                   is_shared = k + 1 < sides.size() && sides[k + 1].key == sides[k].key,
                   is_other_inside = is_shared && mesh.is_inside[sides[k + 1].cell] != 0;
        if (is_inside != is_other_inside)
        {
          triangles.emplace_back();
          for (const unsigned int vertex : sides[k].key)
            triangles.back().push_back(mesh.vertices[vertex]);
        }
        k += is_shared ? 1 : 0;
      }
      return triangles;
    }

    /// Cubes about the middle of a box.
    struct Cubes
    {
      Cubes(const Cuboid &box, double side) : h(side)
      {
        for (unsigned int d = 0; d < 3; ++d)
        {
          const double extent = (box.upper[d] - box.lower[d]) / h;
          n[d] = static_cast<int>(std::floor(extent + rounding));
          origin[d] = box.lower[d] + h * (extent - n[d]) / 2;
          if (std::abs(extent - n[d]) <= rounding)
            origin[d] = box.lower[d];
        }
      }

      Place corner(const std::array<int, 3> &at) const
      {
        return {origin[0] + at[0] * h, origin[1] + at[1] * h, origin[2] + at[2] * h};
      }

      double h;
      std::array<int, 3> n{};
      Place origin;
    };

    void take_out_cut_cubes(const Cubes &cubes, const std::vector<std::vector<Place>> &triangles,
                            std::vector<char> &is_taken)
    {
      for (const std::vector<Place> &triangle : triangles)
      {
        Cuboid box{triangle[0], triangle[0]};
        for (const Place &x : triangle)
          extend(box, x);
        std::array<int, 3> from{}, to{};
        for (unsigned int d = 0; d < 3; ++d)
        {
          from[d] = std::clamp(
              static_cast<int>(std::floor((box.lower[d] - cubes.origin[d]) / cubes.h - rounding)),
              0, cubes.n[d]);
          to[d] = std::clamp(
              static_cast<int>(std::ceil((box.upper[d] - cubes.origin[d]) / cubes.h + rounding)), 0,
              cubes.n[d]);
        }
        for_each_index(
            from, to,
            [&](const std::array<int, 3> &at)
            {
              char &taken = is_taken[number_within(at, cubes.n)];
              Cuboid inner{cubes.corner(at), cubes.corner({at[0] + 1, at[1] + 1, at[2] + 1})};
              for (unsigned int d = 0; d < 3; ++d)
              {
                inner.lower[d] += rounding * cubes.h;
                inner.upper[d] -= rounding * cubes.h;
              }
              if (taken != 0 && cuts(triangle, inner))
                taken = 0;
            });
      }
    }

    /// Volume over the longest edge cubed.
    double roundness(const TetrahedralMesh &mesh, std::size_t cell)
    {
      double longest = 0;
      for (const unsigned int a : mesh.cells[cell])
        for (const unsigned int b : mesh.cells[cell])
          longest = std::max(longest, mesh.vertices[a].distance(mesh.vertices[b]));
      return determinant(mesh, cell) / std::pow(longest, 3);
    }
  } // namespace

  TetrahedronSearch::TetrahedronSearch(const TetrahedralMesh &mesh)
      : mesh_(mesh), search_(boxes_of(mesh, cells_))
  {
  }

  std::vector<Cuboid> TetrahedronSearch::boxes_of(const TetrahedralMesh &mesh,
                                                  std::vector<std::size_t> &cells)
  {
    std::vector<Cuboid> boxes;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      if (mesh.is_inside[cell] != 0)
      {
        cells.push_back(cell);
        const Place &first = mesh.vertices[mesh.cells[cell][0]];
        Cuboid box{first, first};
        for (const unsigned int vertex : mesh.cells[cell])
          extend(box, mesh.vertices[vertex]);
        boxes.push_back(box);
      }
    return boxes;
  }

  std::optional<std::size_t> TetrahedronSearch::find(const dealii::Point<3> &x) const
  {
    if (!std::isfinite(x.square()))
      return {};
    const Cuboid &typical = search_.box(0);
    const double margin = rounding * typical.lower.distance(typical.upper);
    Cuboid about{x, x};
    for (unsigned int d = 0; d < 3; ++d)
    {
      about.lower[d] -= margin;
      about.upper[d] += margin;
    }
    std::vector<unsigned int> near;
    search_.find(about, near);
    double best = -rounding;
    std::optional<std::size_t> found;
    for (const unsigned int k : near)
      if (const double least = least_coordinate(mesh_, cells_[k], x); least >= best)
      {
        best = least;
        found = cells_[k];
      }
    return found;
  }

  Cuboid bounding_box(const TetrahedralMesh &mesh)
  {
    std::optional<Cuboid> box;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      for (const unsigned int vertex : mesh.cells[cell])
        if (mesh.is_inside[cell] != 0)
        {
          if (!box)
            box = {mesh.vertices[vertex], mesh.vertices[vertex]};
          extend(*box, mesh.vertices[vertex]);
        }
    return box.value_or(Cuboid());
  }

  double volume(const TetrahedralMesh &mesh)
  {
    double sum = 0;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      if (mesh.is_inside[cell] != 0)
        sum += determinant(mesh, cell) / 6;
    return sum;
  }

  CubeLattice cubes_within(const TetrahedralMesh &mesh, double h)
  {
    if (!(h > 0) || !std::isfinite(h))
      throw InputError("mesh size h = " + base::to_text(h, 6) + " must be a positive length");
    constexpr double most = 1e8;
    const Cubes cubes(bounding_box(mesh), h);
    const double n_all = static_cast<double>(cubes.n[0]) * cubes.n[1] * cubes.n[2];
    if (n_all > most)
      throw InputError("mesh size h = " + base::to_text(h, 6) + " makes more than " +
                       base::to_text(most, 3) +
                       " cubes in the mesh, over which averages are taken; are the lengths of mesh "
                       "and scene in the same unit? Choose an h of the size of the cells");
    std::vector<char> is_taken(static_cast<std::size_t>(n_all), 1);
    take_out_cut_cubes(cubes, boundary(mesh), is_taken);
    const TetrahedronSearch search(mesh);
    Solid solid;
    int run = 0; // cubes that follow each other along x
    for_each_index({0, 0, 0}, cubes.n,
                   [&](const std::array<int, 3> &at)
                   {
                     const Place middle = cubes.corner(at) + Place(h / 2, h / 2, h / 2);
                     if (is_taken[number_within(at, cubes.n)] != 0 && search.find(middle))
                       ++run;
                     else
                       run = 0;
                     if (run == 0)
                       return;
                     if (run > 1)
                       solid.include.pop_back();
                     solid.include.push_back({cubes.corner({at[0] + 1 - run, at[1], at[2]}),
                                              cubes.corner({at[0] + 1, at[1] + 1, at[2] + 1})});
                     if (at[0] + 1 == cubes.n[0])
                       run = 0;
                   });
    if (solid.include.empty())
      throw InputError("mesh size h = " + base::to_text(h, 6) +
                       ": no cube of this side lies in the domain, over which averages are taken; "
                       "choose a smaller h (Study/h), of the size of the cells");
    return {solid, h};
  }

  NodeCells<3> centroid_nodes(const TetrahedralMesh &mesh)
  {
    NodeCells<3> result;
    result.first_piece = {0};
    const std::size_t n_each = mesh.hexahedra.empty() ? 1 : n_in_hexahedron;
    for (const char is_inside : {1, 0})
      for (std::size_t cell = 0; cell < mesh.cells.size(); cell += n_each)
      {
        if ((mesh.is_inside[cell] != 0) != (is_inside != 0))
          continue;
        double volume = 0;
        dealii::Tensor<1, 3> sum;
        for (std::size_t part = cell; part < cell + n_each; ++part)
        {
          const auto &v = mesh.cells[part];
          result.pieces.push_back(
              ConvexPolyhedron::tetrahedron({mesh.vertices[v[0]], mesh.vertices[v[1]],
                                             mesh.vertices[v[2]], mesh.vertices[v[3]]}));
          const SolidMoments &moments = result.pieces.back().moments();
          volume += moments.volume;
          sum += moments.volume * moments.centroid;
        }
        result.nodes.emplace_back(n_each == 1 ? result.pieces.back().moments().centroid
                                              : Place(sum / volume));
        result.centroid.push_back(result.nodes.back());
        result.area.push_back(volume);
        result.source.push_back(cell / n_each);
        result.first_piece.push_back(result.pieces.size());
        result.n_free += is_inside != 0 ? 1 : 0;
      }
    return result;
  }

  TetrahedralMesh refine(const TetrahedralMesh &mesh)
  {
    if (!mesh.hexahedra.empty())
      return refine_hexahedra(mesh);
    TetrahedralMesh fine{mesh.vertices, {}, {}};
    fine.groups = mesh.groups;
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> middles;
    const auto middle = [&](unsigned int a, unsigned int b)
    {
      const auto [found, is_new] =
          middles.emplace(std::minmax(a, b), static_cast<unsigned int>(fine.vertices.size()));
      if (is_new)
        fine.vertices.push_back(mesh.vertices[a] + (mesh.vertices[b] - mesh.vertices[a]) / 2);
      return found->second;
    };
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    {
      const auto add = [&](const std::array<unsigned int, 4> &vertices)
      {
        fine.cells.push_back(vertices);
        fine.is_inside.push_back(mesh.is_inside[cell]);
        if (!mesh.group.empty())
          fine.group.push_back(mesh.group[cell]);
        if (determinant(fine, fine.cells.size() - 1) < 0)
          std::swap(fine.cells.back()[2], fine.cells.back()[3]);
      };
      const auto &v = mesh.cells[cell];
      for (unsigned int k = 0; k < 4; ++k)
        add({v[k], middle(v[k], v[(k + 1) % 4]), middle(v[k], v[(k + 2) % 4]),
             middle(v[k], v[(k + 3) % 4])});
      std::array<std::array<unsigned int, 2>, 3> diagonals = {
          {{middle(v[0], v[1]), middle(v[2], v[3])},
           {middle(v[0], v[2]), middle(v[1], v[3])},
           {middle(v[0], v[3]), middle(v[1], v[2])}}};
      const auto length = [&](const std::array<unsigned int, 2> &ends)
      { return fine.vertices[ends[0]].distance_square(fine.vertices[ends[1]]); };
      std::swap(diagonals[0], *std::min_element(diagonals.begin(), diagonals.end(),
                                                [&](const auto &a, const auto &b)
                                                { return length(a) < length(b); }));
      const auto &[axis, one, other] = diagonals;
      const std::array<unsigned int, 4> ring = {one[0], other[0], one[1], other[1]};
      for (unsigned int k = 0; k < 4; ++k)
        add({axis[0], axis[1], ring[k], ring[(k + 1) % 4]});
    }
    return fine;
  }

  TetrahedralMesh with_thinnest_first(TetrahedralMesh mesh, std::size_t n)
  {
    std::vector<std::pair<double, std::size_t>> shapes;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      if (mesh.is_inside[cell] != 0)
        shapes.emplace_back(roundness(mesh, cell), cell);
    n = std::min(n, shapes.size());
    std::partial_sort(shapes.begin(), shapes.begin() + static_cast<std::ptrdiff_t>(n),
                      shapes.end());
    std::vector<unsigned int> order(mesh.vertices.size()); // of the vertices' numbers, anew
    std::iota(order.begin(), order.end(), 0);
    std::vector<unsigned int> first;
    std::vector<std::size_t> thin;
    for (std::size_t k = 0; k < n; ++k)
    {
      thin.push_back(shapes[k].second);
      for (const unsigned int vertex : mesh.cells[thin.back()])
        if (std::find(first.begin(), first.end(), vertex) == first.end())
          first.push_back(vertex);
    }
    std::stable_partition(order.begin(), order.end(),
                          [&](unsigned int vertex)
                          { return std::find(first.begin(), first.end(), vertex) != first.end(); });
    TetrahedralMesh result;
    result.groups = mesh.groups;
    std::vector<unsigned int> number(order.size());
    for (std::size_t k = 0; k < order.size(); ++k)
    {
      number[order[k]] = static_cast<unsigned int>(k);
      result.vertices.push_back(mesh.vertices[order[k]]);
    }
    const auto add = [&](std::size_t cell)
    {
      result.cells.push_back(mesh.cells[cell]);
      for (unsigned int &vertex : result.cells.back())
        vertex = number[vertex];
      result.is_inside.push_back(mesh.is_inside[cell]);
      if (!mesh.group.empty())
        result.group.push_back(mesh.group[cell]);
    };
    for (const std::size_t cell : thin)
      add(cell);
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      if (std::find(thin.begin(), thin.end(), cell) == thin.end())
        add(cell);
    return result;
  }
} // namespace plumbline::geometry
