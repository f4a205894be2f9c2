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

    /// The lattice of Ω and the layer around its bounding box, in units of a cube with the lower
    /// corner of the layer at the origin.
    class Frame
    {
    public:
      Frame(const CubeLattice &omega, int n_layers) : omega_(&omega), n_layers_(n_layers)
      {
        for (unsigned int d = 0; d < 3; ++d)
          n_[d] = omega.n_cells()[d] + 2 * n_layers;
      }

      const std::array<int, 3> &n() const { return n_; }

      /// In cubes, of a place [length].
      Place in_cubes(const Place &x) const
      {
        return Place((x - omega_->origin()) / omega_->h() +
                     dealii::Tensor<1, 3>({1. * n_layers_, 1. * n_layers_, 1. * n_layers_}));
      }

      Place place(const Place &in_cubes) const
      {
        Place x;
        for (unsigned int d = 0; d < 3; ++d)
          x[d] = omega_->coordinate(d, in_cubes[d] - n_layers_);
        return x;
      }

      bool is_omega(const std::array<int, 3> &cell) const
      {
        return omega_->is_inside({cell[0] - n_layers_, cell[1] - n_layers_, cell[2] - n_layers_});
      }

      bool is_within(const Place &in_cubes) const
      {
        bool is = true;
        for (unsigned int d = 0; d < 3; ++d)
          is = is && in_cubes[d] >= 0 && in_cubes[d] <= n_[d];
        return is;
      }

      /// Of Ω, or of the layer.
      std::vector<CubeRange> boxes(bool of_omega) const
      {
        std::vector<char> is_inside;
        for_each_index({0, 0, 0}, n_,
                       [&](const std::array<int, 3> &cell)
                       { is_inside.push_back(is_omega(cell) == of_omega ? 1 : 0); });
        return disjoint_boxes(std::move(is_inside), n_);
      }

    private:
      const CubeLattice *omega_;
      int n_layers_;
      std::array<int, 3> n_{};
    };

    /// The part of a cell about a node in a range of cubes; false: there is none.
    bool clip(ClippedPolyhedron &cell, const Place &node, const CubeRange &range)
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
    struct Extent
    {
      Place lower, upper;

      Extent(const ClippedPolyhedron &cell, const Place &node) : lower(node), upper(node)
      {
        for (const Place &x : cell.vertices())
          for (unsigned int d = 0; d < 3; ++d)
          {
            lower[d] = std::min(lower[d], node[d] + x[d]);
            upper[d] = std::max(upper[d], node[d] + x[d]);
          }
      }

      bool is_in(const CubeRange &range) const
      {
        bool is = true;
        for (unsigned int d = 0; d < 3; ++d)
          is = is && lower[d] >= range.lower[d] && upper[d] <= range.upper[d];
        return is;
      }

      bool meets(const CubeRange &range) const
      {
        bool is = true;
        for (unsigned int d = 0; d < 3; ++d)
          is = is && lower[d] < range.upper[d] && upper[d] > range.lower[d];
        return is;
      }
    };

    /// What of a Voronoi cell about a node is in one of the boxes.
    std::vector<ConvexPolyhedron> pieces_of(const ClippedPolyhedron &whole, const Place &node,
                                            const std::vector<CubeRange> &boxes, const Frame &frame)
    {
      const auto placed = [&](const ClippedPolyhedron &cell)
      {
        return cell.placed([&](const Place &x)
                           { return frame.place(node + dealii::Tensor<1, 3>(x)); });
      };
      const Extent extent(whole, node);
      if (std::any_of(boxes.begin(), boxes.end(),
                      [&](const CubeRange &box) { return extent.is_in(box); }))
        return {placed(whole)};
      std::vector<ConvexPolyhedron> pieces;
      double covered = 0;
      for (const CubeRange &box : boxes)
        if (ClippedPolyhedron part = whole; extent.meets(box) && clip(part, node, box))
          if (const double volume = part.volume(); volume > sliver)
          {
            covered += volume;
            pieces.push_back(placed(part));
          }
      if (pieces.size() > 1 && std::abs(covered - whole.volume()) <= uncut * whole.volume())
        return {placed(whole)};
      return pieces;
    }

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
        lower[d] = -margin - x[d];
        upper[d] = frame.n()[d] + margin - x[d];
      }
      ClippedPolyhedron cell(lower, upper);
      std::vector<Delaunay::Vertex_handle> neighbours;
      if (delaunay.dimension() == 3)
        delaunay.finite_adjacent_vertices(node, std::back_inserter(neighbours));
      else // all of them, as they lie in a plane
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
      const std::vector<CubeRange> boxes = frame.boxes(first < result.n_free);
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
        const ClippedPolyhedron whole = voronoi_cell(delaunay, vertices[i - first], frame);
        std::vector<ConvexPolyhedron> pieces;
        if (!whole.vertices().empty())
          pieces = pieces_of(whole, frame.in_cubes(result.nodes[i]), boxes, frame);
        if (pieces.empty())
          reject(result.source[i], result.nodes[i],
                 "has a cell without volume, since others are too near to it; move or take out "
                 "nodes");
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

  NodeCells<3> voronoi_cells(const std::vector<Place> &nodes, const CubeLattice &omega,
                             int n_layers)
  {
    const Frame frame(omega, n_layers);
    NodeCells<3> result;
    std::vector<std::size_t> around;
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      const Place &x = nodes[i];
      if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
        reject(i, x, "is not finite; give finite coordinates");
      if (!frame.is_within(frame.in_cubes(x)))
        reject(i, x,
               "lies outside of the domain and its interaction domain; take it out, or move it in");
      (omega.cell_at(x) ? result.source : around).push_back(i);
    }
    const std::string none = "none of the " + std::to_string(nodes.size()) + " nodes lies in the ";
    if (result.source.empty())
      throw InputError(none + "domain; add nodes there");
    if (around.empty())
      throw InputError(none + "interaction domain; add nodes there, they carry the data");
    if (const auto two = find_coincident_nodes(nodes, omega.h()))
      reject(two->second, nodes[two->second],
             two->place("node " + std::to_string(two->first)) + "; take one of them out");

    result.n_free = result.source.size();
    result.source.insert(result.source.end(), around.begin(), around.end());
    for (const std::size_t i : result.source)
      result.nodes.push_back(nodes[i]);
    result.first_piece = {0};
    add_cells(result, 0, result.n_free, frame);
    add_cells(result, result.n_free, result.size(), frame);
    return result;
  }

  int layers_for(double horizon, double h)
  {
    return static_cast<int>(std::ceil(horizon / h - 1e-9)) + 1;
  }

  int layers_around(const std::vector<Place> &nodes, const CubeLattice &omega, double horizon)
  {
    const Cuboid box = omega.cuboid();
    double most = 0;
    for (unsigned int d = 0; d < 3; ++d)
      for (const bool is_upper : {false, true})
      {
        double margin = -std::numeric_limits<double>::infinity();
        for (const Place &x : nodes)
          margin = std::max(margin, is_upper ? x[d] - box.upper[d] : box.lower[d] - x[d]);
        if (!nodes.empty() && margin < horizon - omega.h())
          throw InputError(
              "nodes end at " + std::string(1, "xyz"[d]) + " = " +
              base::to_text(is_upper ? box.upper[d] + margin : box.lower[d] - margin, 4) +
              ", but the interaction domain is as wide as the horizon = " +
              base::to_text(horizon, 4) + " on all sides; add nodes there");
        most = std::max(most, margin);
      }
    return std::max(layers_for(horizon, omega.h()), static_cast<int>(std::ceil(most / omega.h())));
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
