#include "geometry/node_cells.h"

#include "base/error.h"
#include "geometry/cell_locator.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <sstream>

namespace plumbline::geometry
{
  namespace
  {
    using dealii::Tensor;
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Delaunay = CGAL::Delaunay_triangulation_2<
        Kernel, CGAL::Triangulation_data_structure_2<
                    CGAL::Triangulation_vertex_base_with_info_2<std::size_t, Kernel>>>;

    /// A Voronoi cell of which the mesh covers all but this fraction is cut by no boundary.
    constexpr double uncut = 1e-12;

    /// Nodes nearer than this fraction of a cell's size are one node given twice: the bisector
    /// between them is rounding, at coordinates of a thousand cells.
    constexpr double too_near = 1e-12;

    [[noreturn]] void reject(std::size_t node, const Point<2> &at, const std::string &why)
    {
      std::ostringstream message;
      message << "node " << node << " at (" << at[0] << ", " << at[1] << ") " << why;
      throw InputError(message.str());
    }

    /// Of a convex polygon with the cells of Ω, or with those of the collar.
    std::vector<Polygon> overlaps(const Polygon &polygon, const CellLocator &cells, bool is_inside)
    {
      std::vector<unsigned int> found;
      cells.find(bounding_box(view(polygon)), found);
      std::vector<Polygon> result;
      for (const unsigned int cell : found)
        if (cells.is_inside(cell) == is_inside)
          if (Polygon part = overlap(view(polygon), view(cells.polygon(cell))); !part.empty())
            result.push_back(std::move(part));
      return result;
    }

    double total_area(const std::vector<Polygon> &pieces)
    {
      return std::accumulate(pieces.begin(), pieces.end(), 0.,
                             [](double sum, const Polygon &piece)
                             { return sum + area(view(piece)); });
    }

    /// The part of a frame that is nearer to a node than to its neighbours in the Delaunay
    /// triangulation.
    Polygon voronoi_polygon(const Delaunay &delaunay, const Delaunay::Vertex_handle &node,
                            const Polygon &frame)
    {
      const auto place = [](const Delaunay::Vertex_handle &vertex)
      { return Point<2>(vertex->point().x(), vertex->point().y()); };
      const Point<2> p = place(node);
      // from one point of a bisector to the next: for any shorter way the direction would drown in
      // the rounding of the points where nodes are very near
      const double far = frame[0].distance(frame[2]);
      Polygon polygon = frame;
      const auto first = delaunay.incident_vertices(node);
      if (auto neighbour = first; !first.is_empty())
        do
          if (!delaunay.is_infinite(neighbour))
          {
            const Tensor<1, 2> d = place(neighbour) - p;
            const Point<2> middle = p + .5 * d;
            polygon =
                left_of(view(polygon), middle, middle + far / d.norm() * Point<2>(-d[1], d[0]));
          }
        while (++neighbour != first);
      return polygon;
    }

    /// Adds the cells of nodes[first ... last - 1], all of Ω or all of the collar.
    void add_cells(NodeCells<2> &result, std::size_t first, std::size_t last,
                   const CellLocator &mesh_cells, const Polygon &frame)
    {
      const bool is_inside = first < result.n_free;
      std::vector<std::pair<Delaunay::Point, std::size_t>> points;
      for (std::size_t i = first; i < last; ++i)
        points.push_back({{result.nodes[i][0], result.nodes[i][1]}, i - first});
      const Delaunay delaunay(points.begin(), points.end());
      std::vector<Delaunay::Vertex_handle> vertices(last - first);
      for (const auto &vertex : delaunay.finite_vertex_handles())
        vertices[vertex->info()] = vertex;

      for (const auto &vertex : vertices)
      {
        const Polygon whole = voronoi_polygon(delaunay, vertex, frame);
        std::vector<Polygon> pieces = overlaps(whole, mesh_cells, is_inside);
        if (std::abs(total_area(pieces) - area(view(whole))) <= uncut * area(view(whole)))
          pieces = {whole};
        const double cell_area = total_area(pieces);
        if (!(cell_area > 0))
          reject(
              result.source[first + vertex->info()], result.nodes[first + vertex->info()],
              "has a cell without area, since others are too near to it; move or take out nodes");
        Point<2> cell_centroid;
        for (const Polygon &piece : pieces)
          cell_centroid += area(view(piece)) / cell_area * centroid(view(piece));
        result.area.push_back(cell_area);
        result.centroid.push_back(cell_centroid);
        std::move(pieces.begin(), pieces.end(), std::back_inserter(result.pieces));
        result.first_piece.push_back(result.pieces.size());
      }
    }
  } // namespace

  template <>
  Box NodeCells<2>::bounding_box(std::size_t cell) const
  {
    Polygon vertices;
    for (std::size_t piece = first_piece[cell]; piece < first_piece[cell + 1]; ++piece)
      vertices.insert(vertices.end(), pieces[piece].begin(), pieces[piece].end());
    return geometry::bounding_box(view(vertices));
  }

  template <int dim>
  std::optional<CoincidentNodes> find_coincident_nodes(const std::vector<Point<dim>> &nodes,
                                                       double size)
  {
    std::vector<typename BoxSearch<dim>::Box> places;
    for (const Point<dim> &x : nodes)
      places.push_back({x, x});
    const BoxSearch<dim> search(places);
    std::vector<unsigned int> near;
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      typename BoxSearch<dim>::Box around = places[i];
      for (unsigned int d = 0; d < dim; ++d)
      {
        around.lower[d] -= too_near * size;
        around.upper[d] += too_near * size;
      }
      search.find(around, near);
      for (const unsigned int j : near)
        if (j < i && nodes[i].distance(nodes[j]) < too_near * size)
          return CoincidentNodes{j, i, nodes[i].distance(nodes[j]), size};
    }
    return {};
  }

  template std::optional<CoincidentNodes> find_coincident_nodes(const std::vector<Point<2>> &,
                                                                double);
  template std::optional<CoincidentNodes> find_coincident_nodes(const std::vector<Point<3>> &,
                                                                double);

  std::optional<CoincidentNodes> find_coincident_nodes(const std::vector<Point<2>> &nodes,
                                                       const Mesh &mesh)
  {
    double whole = 0;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      whole += area(view(mesh.polygon(cell)));
    return find_coincident_nodes(nodes, std::sqrt(whole / static_cast<double>(nodes.size())));
  }

  std::string CoincidentNodes::place(const std::string &name) const
  {
    if (distance == 0)
      return "lies where " + name + " is";
    std::ostringstream text;
    text << "lies " << distance << " from " << name << ", nearer than " << too_near
         << " of the cells' size " << size;
    return text.str();
  }

  NodeCells<2> voronoi_cells(const std::vector<Point<2>> &nodes, const Mesh &mesh)
  {
    const CellLocator mesh_cells(mesh);
    NodeCells<2> result;
    std::vector<std::size_t> in_collar;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (!std::isfinite(nodes[i][0]) || !std::isfinite(nodes[i][1]))
        reject(i, nodes[i], "is not finite; give finite coordinates");
      else if (const auto cell = mesh_cells.find(nodes[i]))
        (mesh_cells.is_inside(*cell) ? result.source : in_collar).push_back(i);
      else
        reject(i, nodes[i],
               "lies outside of the domain and its collar; take it out, or move it in");
    if (result.source.empty())
      throw InputError("none of the " + std::to_string(nodes.size()) +
                       " nodes lies in the domain; add nodes there");
    if (in_collar.empty() && std::any_of(mesh.cells.begin(), mesh.cells.end(),
                                         [](const MeshCell &cell) { return !cell.is_inside; }))
      throw InputError("none of the " + std::to_string(nodes.size()) +
                       " nodes lies in the collar; add nodes there, they carry the data");

    result.n_free = result.source.size();
    result.source.insert(result.source.end(), in_collar.begin(), in_collar.end());
    for (const std::size_t i : result.source)
      result.nodes.push_back(nodes[i]);
    if (const auto twins = find_coincident_nodes(nodes, mesh))
      reject(twins->second, nodes[twins->second],
             twins->place("node " + std::to_string(twins->first)) + "; take one of them out");

    const Box box = bounding_box(view(mesh.vertices));
    const Polygon frame{box.lower, Point<2>(box.upper[0], box.lower[1]), box.upper,
                        Point<2>(box.lower[0], box.upper[1])};
    result.first_piece = {0};
    add_cells(result, 0, result.n_free, mesh_cells, frame);
    add_cells(result, result.n_free, result.size(), mesh_cells, frame);
    return result;
  }

  std::vector<Point<2>> centroids(const Mesh &mesh)
  {
    std::vector<Point<2>> result;
    for (std::size_t c = 0; c < mesh.cells.size() && mesh.wholes.empty(); ++c)
      result.push_back(centroid(view(mesh.polygon(c))));
    for (std::size_t w = 0; w < mesh.wholes.size(); ++w)
    {
      Point<2> sum;
      double all = 0;
      const std::size_t end =
          w + 1 < mesh.wholes.size() ? mesh.wholes[w + 1].first_part : mesh.cells.size();
      for (std::size_t c = mesh.wholes[w].first_part; c < end; ++c)
      {
        const Polygon part = mesh.polygon(c);
        const double of_part = area(view(part));
        sum += of_part * centroid(view(part));
        all += of_part;
      }
      result.push_back(sum / all);
    }
    return result;
  }

  std::vector<Point<2>> lattice_nodes(const Mesh &mesh, double h, double perturbation,
                                      unsigned int seed)
  {
    if (!(h > 0))
      throw InputError("lattice of nodes with h = " + std::to_string(h) +
                       "; give a positive length");
    const CellLocator cells(mesh);
    const auto is_inside = [&](const Point<2> &x) -> std::optional<bool>
    {
      const auto cell = cells.find(x);
      return cell ? std::optional(cells.is_inside(*cell)) : std::nullopt;
    };
    const Box box = bounding_box(view(mesh.vertices));
    const Point<2> origin = bounding_box(mesh).lower;
    std::array<int, 2> from{}, to{};
    for (unsigned int d = 0; d < 2; ++d)
    {
      from[d] = static_cast<int>(std::floor((box.lower[d] - origin[d]) / h));
      to[d] = static_cast<int>(std::ceil((box.upper[d] - origin[d]) / h));
    }
    std::mt19937 random(seed);
    const auto draw = [&] { return perturbation * h * (2 * (random() * 0x1p-32) - 1); };
    std::vector<Point<2>> nodes;
    for (int j = from[1]; j < to[1]; ++j)
      for (int i = from[0]; i < to[0]; ++i)
      {
        const Point<2> centre = origin + h * Point<2>(i + .5, j + .5);
        const auto side = is_inside(centre);
        if (!side)
          continue;
        Point<2> move;
        move[0] = draw();
        move[1] = draw();
        while (is_inside(centre + move) != side)
          move *= .5;
        nodes.push_back(centre + move);
      }
    return nodes;
  }
} // namespace plumbline::geometry
