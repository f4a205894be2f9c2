#include "geometry/node_cells_in_space.h"

#include "base/error.h"
#include "base/number_text.h"
#include "geometry/cell_counts.h"
#include "geometry/polyhedron_clip.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace plumbline::geometry
{
  namespace
  {
    using Place = dealii::Point<3>;
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Delaunay = CGAL::Delaunay_triangulation_3<
        Kernel, CGAL::Triangulation_data_structure_3<
                    CGAL::Triangulation_vertex_base_with_info_3<std::size_t, Kernel>,
                    CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>;

    /// A Voronoi cell of which Ω or the layer covers all but this fraction is cut by no boundary.
    constexpr double uncut = 1e-12;

    /// Of a cube: pieces below that are rounding.
    constexpr double sliver = 1e-14;

    [[noreturn]] void reject(std::size_t node, const Place &at, const std::string &why)
    {
      std::ostringstream message;
      message << "node " << node << " at (" << at[0] << ", " << at[1] << ", " << at[2] << ") "
              << why;
      throw InputError(message.str());
    }

    /// Boxes of cells that share none and make up a set of cells, greedily.
    /// @param is_inside  shape (n[2], n[1], n[0]); taken out of it
    std::vector<CubeRange> disjoint_boxes(std::vector<char> is_inside, const std::array<int, 3> &n)
    {
      const auto is_filled = [&](const CubeRange &range)
      {
        bool is = true;
        for_each_index(range.lower, range.upper,
                       [&](const std::array<int, 3> &cell)
                       { is = is && is_inside[number_within(cell, n)] != 0; });
        return is;
      };
      std::vector<CubeRange> boxes;
      for_each_index({0, 0, 0}, n,
                     [&](const std::array<int, 3> &cell)
                     {
                       if (is_inside[number_within(cell, n)] == 0)
                         return;
                       CubeRange box{cell, {cell[0] + 1, cell[1] + 1, cell[2] + 1}};
                       for (unsigned int d = 0; d < 3; ++d)
                         for (bool is_growing = true; is_growing && box.upper[d] < n[d];)
                         {
                           CubeRange next = box;
                           next.lower[d] = box.upper[d];
                           next.upper[d] = box.upper[d] + 1;
                           is_growing = is_filled(next);
                           box.upper[d] += is_growing ? 1 : 0;
                         }
                       for_each_index(box.lower, box.upper,
                                      [&](const std::array<int, 3> &taken)
                                      { is_inside[number_within(taken, n)] = 0; });
                       boxes.push_back(box);
                     });
      return boxes;
    }

    /// How Ω, and a layer around its bounding box, are made up of boxes, in units of the lattice's
    /// cubes about the lower corner of that box.
    class Frame
    {
    public:
      /// @param layer  with Ω [length]
      Frame(const CubeLattice &omega, const Cuboid &layer)
          : omega_(&omega), layer_{in_cubes(layer.lower), in_cubes(layer.upper)}
      {
      }

      const Cuboid &layer() const { return layer_; }

      /// In cubes, of a place [length].
      Place in_cubes(const Place &x) const { return Place((x - omega_->origin()) / omega_->h()); }

      Place place(const Place &in_cubes) const
      {
        Place x;
        for (unsigned int d = 0; d < 3; ++d)
          x[d] = omega_->coordinate(d, in_cubes[d]);
        return x;
      }

      /// Of Ω, or of the layer.
      std::vector<Cuboid> boxes(bool of_omega) const
      {
        std::array<int, 3> from{}, to{}, n{};
        for (unsigned int d = 0; d < 3; ++d)
        {
          from[d] = static_cast<int>(std::floor(layer_.lower[d]));
          to[d] = static_cast<int>(std::ceil(layer_.upper[d]));
          n[d] = to[d] - from[d];
        }
        std::vector<char> is_wanted;
        for_each_index(from, to,
                       [&](const std::array<int, 3> &cell)
                       { is_wanted.push_back(omega_->is_inside(cell) == of_omega ? 1 : 0); });
        std::vector<Cuboid> result;
        for (const CubeRange &box : disjoint_boxes(std::move(is_wanted), n))
        {
          Cuboid range;
          bool is_there = true;
          for (unsigned int d = 0; d < 3; ++d)
          {
            range.lower[d] = std::max(layer_.lower[d], 1. * from[d] + box.lower[d]);
            range.upper[d] = std::min(layer_.upper[d], 1. * from[d] + box.upper[d]);
            is_there = is_there && range.lower[d] < range.upper[d];
          }
          if (is_there)
            result.push_back(range);
        }
        return result;
      }

    private:
      const CubeLattice *omega_;
      Cuboid layer_;
    };

    /// The part of a cell about a node in a box; false: there is none.
    bool clip(ClippedPolyhedron &cell, const Place &node, const Cuboid &range)
    {
      for (unsigned int d = 0; d < 3; ++d)
      {
        dealii::Tensor<1, 3> axis;
        axis[d] = 1;
        if (!cell.clip(axis, range.upper[d] - node[d]) ||
            !cell.clip(-axis, node[d] - range.lower[d]))
          return false;
      }
      return true;
    }

    /// Of a cell about a node, in cubes.
    struct Extent : Cuboid
    {
      Extent(const ClippedPolyhedron &cell, const Place &node) : Cuboid{node, node}
      {
        for (const Place &x : cell.vertices())
          for (unsigned int d = 0; d < 3; ++d)
          {
            lower[d] = std::min(lower[d], node[d] + x[d]);
            upper[d] = std::max(upper[d], node[d] + x[d]);
          }
      }

      bool is_in(const Cuboid &range) const
      {
        bool is = true;
        for (unsigned int d = 0; d < 3; ++d)
          is = is && lower[d] >= range.lower[d] && upper[d] <= range.upper[d];
        return is;
      }
    };

    /// Boxes in cubes that are looked for.
    class Boxes
    {
    public:
      explicit Boxes(std::vector<Cuboid> boxes) : search_(std::move(boxes)) {}

      /// What of a Voronoi cell about a node is in one of them.
      std::vector<ConvexPolyhedron> pieces_of(const ClippedPolyhedron &whole, const Place &node,
                                              const Frame &frame) const
      {
        const auto placed = [&](const ClippedPolyhedron &cell)
        {
          return cell.placed([&](const Place &x)
                             { return frame.place(node + dealii::Tensor<1, 3>(x)); });
        };
        const Extent extent(whole, node);
        std::vector<unsigned int> near;
        search_.find(extent, near);
        if (std::any_of(near.begin(), near.end(),
                        [&](unsigned int box) { return extent.is_in(search_.box(box)); }))
          return {placed(whole)};
        std::vector<ConvexPolyhedron> pieces;
        double covered = 0;
        for (const unsigned int box : near)
          if (ClippedPolyhedron part = whole; clip(part, node, search_.box(box)))
            if (const double volume = part.volume(); volume > sliver)
            {
              covered += volume;
              pieces.push_back(placed(part));
            }
        if (pieces.size() > 1 && std::abs(covered - whole.volume()) <= uncut * whole.volume())
          return {placed(whole)};
        return pieces;
      }

    private:
      BoxSearch<3> search_;
    };

    /// The part of a frame that is nearer to a node than to its neighbours in the Delaunay
    /// triangulation, about the node.
    ClippedPolyhedron voronoi_cell(const Delaunay &delaunay, const Delaunay::Vertex_handle &node,
                                   const Frame &frame)
    {
      constexpr double margin = 1; // what is there is cut off by boxes
      const auto place = [](const Delaunay::Vertex_handle &vertex)
      { return Place(vertex->point().x(), vertex->point().y(), vertex->point().z()); };
      const Place x = place(node);
      Place lower, upper;
      for (unsigned int d = 0; d < 3; ++d)
      {
        lower[d] = frame.layer().lower[d] - margin - x[d];
        upper[d] = frame.layer().upper[d] + margin - x[d];
      }
      ClippedPolyhedron cell(lower, upper);
      std::vector<Delaunay::Vertex_handle> neighbours;
      if (delaunay.dimension() >= 2)
        delaunay.finite_adjacent_vertices(node, std::back_inserter(neighbours));
      else // all of them, as they lie on a line
        for (const Delaunay::Vertex_handle other : delaunay.finite_vertex_handles())
          if (other != node)
            neighbours.push_back(other);
      std::vector<dealii::Tensor<1, 3>> ways;
      for (const auto &neighbour : neighbours)
        ways.push_back(place(neighbour) - x);
      std::sort(ways.begin(), ways.end(),
                [](const auto &a, const auto &b) { return a.norm_square() < b.norm_square(); });
      for (const dealii::Tensor<1, 3> &way : ways)
        (void)cell.clip(way, way.norm_square() / 2);
      return cell;
    }

    void append(NodeCells<3> &result, std::vector<ConvexPolyhedron> pieces)
    {
      double volume = 0;
      Place centroid;
      for (const ConvexPolyhedron &piece : pieces)
        volume += piece.moments().volume;
      for (const ConvexPolyhedron &piece : pieces)
        centroid += piece.moments().volume / volume * piece.moments().centroid;
      result.area.push_back(volume);
      result.centroid.push_back(centroid);
      std::move(pieces.begin(), pieces.end(), std::back_inserter(result.pieces));
      result.first_piece.push_back(result.pieces.size());
    }

    /// Adds the cells of nodes[first ... last - 1], all of Ω or all of the layer.
    void add_cells(NodeCells<3> &result, std::size_t first, std::size_t last, const Frame &frame)
    {
      const Boxes boxes(frame.boxes(first < result.n_free));
      std::vector<std::pair<Delaunay::Point, std::size_t>> points;
      for (std::size_t i = first; i < last; ++i)
      {
        const Place x = frame.in_cubes(result.nodes[i]);
        points.push_back({{x[0], x[1], x[2]}, i - first});
      }
      const Delaunay delaunay(points.begin(), points.end());
      std::vector<Delaunay::Vertex_handle> vertices(last - first);
      for (const auto &vertex : delaunay.finite_vertex_handles())
        vertices[vertex->info()] = vertex;
      for (std::size_t i = first; i < last; ++i)
      {
        std::vector<ConvexPolyhedron> pieces;
        try
        {
          const ClippedPolyhedron whole = voronoi_cell(delaunay, vertices[i - first], frame);
          if (!whole.vertices().empty())
            pieces = boxes.pieces_of(whole, frame.in_cubes(result.nodes[i]), frame);
        }
        catch (const std::runtime_error &error)
        {
          reject(result.source[i], result.nodes[i],
                 std::string("cannot have a Voronoi cell: ") + error.what());
        }
        if (pieces.empty())
          reject(result.source[i], result.nodes[i],
                 "has a Voronoi cell of zero volume because other nodes are too close; move or "
                 "remove nodes");
        append(result, std::move(pieces));
      }
    }
  } // namespace

  template <>
  Cuboid NodeCells<3>::bounding_box(std::size_t cell) const
  {
    Cuboid box{pieces[first_piece[cell]].vertices().front(), {}};
    box.upper = box.lower;
    for (std::size_t piece = first_piece[cell]; piece < first_piece[cell + 1]; ++piece)
      for (const Place &x : pieces[piece].vertices())
        for (unsigned int d = 0; d < 3; ++d)
        {
          box.lower[d] = std::min(box.lower[d], x[d]);
          box.upper[d] = std::max(box.upper[d], x[d]);
        }
    return box;
  }

  namespace
  {
    /// Beyond a box, 0 in it.
    double distance(const Place &x, const Cuboid &box)
    {
      double square = 0;
      for (unsigned int d = 0; d < 3; ++d)
        square += std::pow(std::max({0., box.lower[d] - x[d], x[d] - box.upper[d]}), 2);
      return std::sqrt(square);
    }

    /// The same along the axis where it is most.
    double largest_distance(const Place &x, const Cuboid &box)
    {
      double most = 0;
      for (unsigned int d = 0; d < 3; ++d)
        most = std::max({most, box.lower[d] - x[d], x[d] - box.upper[d]});
      return most;
    }

    /// As far as nodes go beyond a box on each side, and half their spacing more.
    Cuboid layer_of(const std::vector<Place> &nodes, const Cuboid &box, double horizon,
                    double spacing)
    {
      Cuboid layer = box;
      for (unsigned int d = 0; d < 3; ++d)
        for (const bool is_upper : {false, true})
        {
          double margin = -std::numeric_limits<double>::infinity();
          for (const Place &x : nodes)
            margin = std::max(margin, is_upper ? x[d] - box.upper[d] : box.lower[d] - x[d]);
          if (margin < horizon - 1.01 * spacing)
            throw InputError(
                "nodes end at " + std::string(1, "xyz"[d]) + " = " +
                base::to_text(is_upper ? box.upper[d] + margin : box.lower[d] - margin, 4) +
                ", but the interaction domain extends by the reach of the kernel (" +
                base::to_text(horizon, 4) + ") beyond the domain on every side; add nodes there");
          (is_upper ? layer.upper : layer.lower)[d] +=
              (is_upper ? 1 : -1) * (std::max(margin, 0.) + spacing / 2);
        }
      return layer;
    }

    /// That each place of the interaction domain has a node near it, so that cells are of its size.
    void check_filled(const NodeCells<3> &cells, const CubeLattice &omega, double horizon,
                      double spacing)
    {
      constexpr double far = 2.5; // spacings
      const std::vector<Cuboid> boxes = omega.boxes();
      for (std::size_t i = cells.n_free; i < cells.size(); ++i)
        for (std::size_t p = cells.first_piece[i]; p < cells.first_piece[i + 1]; ++p)
          for (const Place &x : cells.pieces[p].vertices())
            if (x.distance(cells.nodes[i]) > far * spacing &&
                std::any_of(boxes.begin(), boxes.end(),
                            [&](const Cuboid &box) { return distance(x, box) < .999 * horizon; }))
            {
              std::ostringstream why;
              why << "is the nearest one to (" << x[0] << ", " << x[1] << ", " << x[2]
                  << ") in the interaction domain, " << x.distance(cells.nodes[i])
                  << " away, where nodes are about " << spacing << " apart; add nodes there";
              reject(cells.source[i], cells.nodes[i], why.str());
            }
    }
  } // namespace

  NodeCells<3> voronoi_cells(const std::vector<Place> &nodes, const CubeLattice &omega,
                             double horizon)
  {
    constexpr double most = 3; // between spacing and h
    NodeCells<3> result;
    std::vector<std::size_t> around;
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      const Place &x = nodes[i];
      if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
        reject(i, x, "is not finite; give finite coordinates");
      (omega.cell_at(x) ? result.source : around).push_back(i);
    }
    const std::string none = "none of the " + std::to_string(nodes.size()) + " nodes lies in the ";
    if (result.source.empty())
      throw InputError(none + "domain; are their lengths in the same unit? Add nodes there");
    result.n_free = result.source.size();
    const double spacing = omega.h() * std::cbrt(static_cast<double>(omega.size()) /
                                                 static_cast<double>(result.n_free));
    if (spacing > most * omega.h() || omega.h() > most * spacing)
      throw InputError("nodes are about " + base::to_text(spacing, 4) +
                       " apart, but h = " + base::to_text(omega.h(), 4) +
                       "; are the lengths of nodes and domain in the same unit? Take an h of the "
                       "size of the spacing");
    std::vector<Place> kept;
    for (const std::size_t i : around)
      if (largest_distance(nodes[i], omega.cuboid()) <= horizon + 2 * spacing)
      {
        result.source.push_back(i);
        kept.push_back(nodes[i]);
      }
    if (kept.empty())
      throw InputError(none +
                       "interaction domain; add nodes there, they carry the prescribed values");
    for (const std::size_t i : result.source)
      result.nodes.push_back(nodes[i]);
    if (const auto two = find_coincident_nodes(nodes, spacing))
      reject(two->second, nodes[two->second],
             two->place("node " + std::to_string(two->first)) + "; take one of them out");

    const Frame frame(omega, layer_of(kept, omega.cuboid(), horizon, spacing));
    result.first_piece = {0};
    add_cells(result, 0, result.n_free, frame);
    add_cells(result, result.n_free, result.size(), frame);
    check_filled(result, omega, horizon, spacing);
    return result;
  }

  int layers_for(double horizon, double h)
  {
    return static_cast<int>(std::ceil(horizon / h - 1e-9)) + 1;
  }

  std::vector<Place> lattice_nodes(const CubeLattice &omega, int n_layers, double perturbation,
                                   unsigned int seed)
  {
    std::mt19937 random(seed);
    const auto draw = [&] { return perturbation * (2 * (random() * 0x1p-32) - 1); };
    std::array<int, 3> lower{}, upper{};
    for (unsigned int d = 0; d < 3; ++d)
    {
      lower[d] = -n_layers;
      upper[d] = omega.n_cells()[d] + n_layers;
    }
    std::vector<Place> nodes;
    for_each_index(lower, upper,
                   [&](const std::array<int, 3> &cell)
                   {
                     Place x;
                     for (unsigned int d = 0; d < 3; ++d)
                       x[d] = omega.coordinate(d, cell[d] + .5 + draw());
                     nodes.push_back(x);
                   });
    return nodes;
  }
} // namespace plumbline::geometry
