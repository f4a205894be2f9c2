#include "geometry/node_cells_in_space.h"

#include "base/error.h"
#include "base/number_text.h"
#include "geometry/cell_counts.h"

#include <voro++/voro++.hh>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <sstream>
#include <utility>

namespace plumbline::geometry
{
  namespace
  {
    using Place = dealii::Point<3>;

    /// A Voronoi cell of which Ω or the layer covers all but this fraction is cut by no boundary.
    constexpr double uncut = 1e-12;

    /// Of a cube: vertices nearer to each other are one, whose face between them is rounding.
    /// voro++ takes vertices so near a plane as lying on it.
    constexpr double same_vertex = 1e-10;

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

    /// A polyhedron in cubes about a node, as ConvexPolyhedron takes it; empty where it is none but
    /// for rounding.
    std::optional<ConvexPolyhedron> polyhedron(voro::voronoicell &cell, const Place &node,
                                               const Frame &frame)
    {
      std::vector<double> coordinates;
      std::vector<int> sides;
      cell.vertices(coordinates);
      cell.face_vertices(sides); // of each face: how many, and which
      std::vector<Place> vertices;
      std::vector<unsigned int> merged;
      for (std::size_t v = 0; v < coordinates.size(); v += 3)
      {
        const Place x =
            node + dealii::Tensor<1, 3>({coordinates[v], coordinates[v + 1], coordinates[v + 2]});
        const auto near =
            std::find_if(vertices.begin(), vertices.end(),
                         [&](const Place &other) { return x.distance(other) < same_vertex; });
        merged.push_back(static_cast<unsigned int>(near - vertices.begin()));
        if (near == vertices.end())
          vertices.push_back(x);
      }
      for (Place &x : vertices)
        x = frame.place(x);

      std::vector<ConvexPolyhedron::Indices> faces;
      for (std::size_t at = 0; at < sides.size(); at += 1 + static_cast<std::size_t>(sides[at]))
      {
        ConvexPolyhedron::Indices face;
        for (int k = 1; k <= sides[at]; ++k)
          if (const unsigned int vertex =
                  merged[static_cast<std::size_t>(sides[at + static_cast<std::size_t>(k)])];
              face.empty() || face.back() != vertex)
            face.push_back(vertex);
        while (face.size() > 1 && face.back() == face.front())
          face.pop_back();
        if (face.size() > 2)
          faces.push_back(std::move(face));
      }
      if (faces.size() < 4)
        return {};
      return ConvexPolyhedron(std::move(vertices), std::move(faces));
    }

    /// The part of a cell in a range of cubes; false: there is none.
    bool clip(voro::voronoicell &cell, const Place &node, const CubeRange &range)
    {
      for (unsigned int d = 0; d < 3; ++d)
      {
        std::array<double, 3> normal{};
        normal[d] = 1; // a plane is given by twice its distance
        if (!cell.plane(normal[0], normal[1], normal[2], 2 * (range.upper[d] - node[d])) ||
            !cell.plane(-normal[0], -normal[1], -normal[2], 2 * (node[d] - range.lower[d])))
          return false;
      }
      return true;
    }

    struct Extent
    {
      Place lower, upper;

      Extent(voro::voronoicell &cell, const Place &node) : lower(node), upper(node)
      {
        std::vector<double> coordinates;
        cell.vertices(coordinates);
        for (std::size_t v = 0; v < coordinates.size(); ++v)
        {
          const unsigned int d = v % 3;
          lower[d] = std::min(lower[d], node[d] + coordinates[v]);
          upper[d] = std::max(upper[d], node[d] + coordinates[v]);
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

    /// What of a Voronoi cell is in one of the boxes.
    std::vector<ConvexPolyhedron> pieces_of(voro::voronoicell &whole, const Place &node,
                                            const std::vector<CubeRange> &boxes, const Frame &frame)
    {
      std::vector<ConvexPolyhedron> pieces;
      const auto add = [&](voro::voronoicell &cell)
      {
        if (auto piece = polyhedron(cell, node, frame))
          pieces.push_back(std::move(*piece));
      };
      const Extent extent(whole, node);
      for (const CubeRange &box : boxes)
        if (extent.is_in(box))
        {
          add(whole);
          return pieces;
        }
      double covered = 0;
      for (const CubeRange &box : boxes)
        if (extent.meets(box))
          if (voro::voronoicell part(whole); clip(part, node, box))
          {
            covered += part.volume();
            add(part);
          }
      if (pieces.size() > 1 && std::abs(covered - whole.volume()) <= uncut * whole.volume())
      {
        pieces.clear();
        add(whole);
      }
      return pieces;
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
      constexpr double margin = 1; // voro++ leaves out nodes on its upper boundary
      constexpr double per_block = 5;
      constexpr int room = 8;
      const std::vector<CubeRange> boxes = frame.boxes(first < result.n_free);
      std::array<int, 3> n_blocks{};
      double volume = 1;
      for (const int n : frame.n())
        volume *= n + 2 * margin;
      const double side = std::cbrt(per_block * volume /
                                    static_cast<double>(std::max<std::size_t>(1, last - first)));
      for (unsigned int d = 0; d < 3; ++d)
        n_blocks[d] = 1 + static_cast<int>((frame.n()[d] + 2 * margin) / side);
      voro::container nodes(-margin, frame.n()[0] + margin, -margin, frame.n()[1] + margin, -margin,
                            frame.n()[2] + margin, n_blocks[0], n_blocks[1], n_blocks[2], false,
                            false, false, room);
      voro::particle_order order;
      for (std::size_t i = first; i < last; ++i)
      {
        const Place x = frame.in_cubes(result.nodes[i]);
        nodes.put(order, static_cast<int>(i), x[0], x[1], x[2]);
      }
      voro::c_loop_order loop(nodes, order);
      std::size_t i = first;
      if (loop.start())
        do
        {
          voro::voronoicell whole;
          std::vector<ConvexPolyhedron> pieces;
          const Place x = frame.in_cubes(result.nodes[i]);
          if (nodes.compute_cell(whole, loop))
            pieces = pieces_of(whole, x, boxes, frame);
          if (pieces.empty())
            reject(result.source[i], result.nodes[i],
                   "has a cell without volume, since others are too near to it; move or take out "
                   "nodes");
          append(result, std::move(pieces));
          ++i;
        } while (loop.inc());
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
          throw InputError("nodes end at " + std::string(1, "xyz"[d]) + " = " +
                           base::to_text(is_upper ? box.upper[d] + margin : box.lower[d] - margin,
                                         4) +
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
